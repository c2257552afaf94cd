#include <reference_fem/cut/conservative/stage.h>

#include <reference_fem/cut/conservative/front_law.h>
#include <reference_fem/cut/conservative/linear_system.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace meltfront::reference_fem::cut::conservative
{
  namespace
  {
    /** Spacings: passes end when what is left to move is less. */
    constexpr double settled = 1e-2;

    /** Spacings: passes that move the front by less and do not make it less go to and fro
     * about a node at which what is released jumps for the quadrature. */
    constexpr double small = 0.02;

    /** What passes are still going to move if each goes on to make as much less. */
    double rest(double move, double before)
    {
      return move < before / 2 ? move * move / (before - move) : move;
    }

    /** One linear system of a stage and what its solution says. */
    class StagePass
    {
    public:
      StagePass(PhaseAssembly &assembly, const cases::Scene &scene,
                const StepFrame &frame, const Front &front, const StageData &data,
                const Guess &guess)
        : frame(frame)
        , front(front)
        , data(data)
        , per_area(data.duration
                   / (scene.material.solid.density * scene.material.latent_heat))
      {
        for(const Phase phase : phases)
          operators.push_back(
              assembly.assemble(phase, frame, front, data.time, guess, true));
      }

      void solve(const Values &increment)
      {
        LocalVector load = LocalVector::Zero(frame.unknowns);
        entries.clear();
        for(const Phase phase : phases)
          add_heat(phase, load);
        if(frame.has_front())
          add_front(increment, load);
        solution = conservative::solve(frame.unknowns, entries, load);
      }

      Values heat(Phase phase) const
      {
        return operators[index(phase)].mass.apply(solution);
      }

      /** Heat that enters both phases through the front, by hat (W/m). */
      Values flux() const
      {
        Values result = operators[index(Phase::solid)].source_flux;
        for(const Phase phase : phases)
        {
          const Values of_phase = operators[index(phase)].front.apply(solution);
          for(std::size_t i = 0; i < result.size(); ++i)
            result[i] += of_phase[i];
        }
        return result;
      }

      double wall_power() const
      {
        double power = 0;
        for(const Phase phase : phases)
          power += sum(operators[index(phase)].wall.apply(solution))
                   + operators[index(phase)].source_wall_power;
        return power;
      }

      double released_power() const
      {
        double power = 0;
        for(const Phase phase : phases)
          power += sum(operators[index(phase)].interior.constant);
        return power;
      }

      LocalVector solution;
      std::vector<Eigen::Triplet<double>> entries;

    private:
      void add_heat(Phase phase, LocalVector &load)
      {
        const PhaseOperators &terms = operators[index(phase)];
        const std::vector<int> &rows = frame.temperature[index(phase)];
        append(terms.mass, 1, rows, entries);
        for(const Operator *term : {&terms.interior, &terms.wall, &terms.front})
          append(*term, -data.duration, rows, entries);
        for(std::size_t node = 0; node < rows.size(); ++node)
          if(rows[node] >= 0)
            load[rows[node]]
                = data.heat[index(phase)][node] - terms.mass.constant[node]
                  + data.duration
                        * (terms.interior.constant[node] + terms.wall.constant[node]
                           + terms.front.constant[node]);
          else if(data.heat[index(phase)][node] != 0)
            throw std::runtime_error("a phase holds heat where it has no temperature");
      }

      void add_front(const Values &increment, LocalVector &load)
      {
        Values change = data.change;
        for(const PhaseOperators &terms : operators)
        {
          append(terms.front, per_area, frame.displacement, entries);
          for(std::size_t node = 0; node < change.size(); ++node)
            change[node]
                += per_area * (terms.front.constant[node] + terms.source_flux[node]);
        }
        add_area_law(frame, front, change, increment, entries, load);
      }

      const StepFrame &frame;
      const Front &front;
      const StageData &data;
      const double per_area; ///< m^2 of solid, of a watt for the stage's duration
      std::vector<PhaseOperators> operators; ///< by Phase
    };

    Temperatures temperatures(const StepFrame &frame, const LocalVector &solution)
    {
      Temperatures result;
      for(const Phase phase : phases)
      {
        const std::vector<int> &unknown = frame.temperature[index(phase)];
        result[index(phase)].assign(unknown.size(), 0);
        for(std::size_t node = 0; node < unknown.size(); ++node)
          if(unknown[node] >= 0)
            result[index(phase)][node] = solution[unknown[node]];
      }
      return result;
    }
  } // namespace

  StageResult solve_stage(PhaseAssembly &assembly, const cases::Scene &scene,
                          const TriangleMesh &mesh, const StepFrame &frame,
                          const StageData &data, int passes)
  {
    StageResult result;
    Values predicted = data.increment;
    for(std::size_t node = 0; node < predicted.size(); ++node)
      if(frame.displacement[node] < 0)
        predicted[node] = 0;
    Guess guess = data.guess;
    assembly.forget_stage();
    const double per_area
        = data.duration / (scene.material.solid.density * scene.material.latent_heat);
    FrontMove move(mesh, frame, data.change, predicted);
    const bool moves = frame.has_front();
    // Without a front only radiation needs more than one.
    const int most = moves ? passes : 2;
    result.settled = !moves;
    double before = 0;
    bool to_and_fro = false, last = false;
    for(int pass = 1; !last; ++pass)
    {
      StagePass stage(assembly, scene, frame, *move.front, data, guess);
      stage.solve(move.increment);
      ++result.solves;
      result.entries += static_cast<long>(stage.entries.size());
      guess.temperatures = temperatures(frame, stage.solution);
      const Values flux = stage.flux();
      if(moves)
      {
        Values change = data.change;
        for(std::size_t node = 0; node < change.size(); ++node)
          change[node] += per_area * flux[node];
        move.make(stage.solution, change);
        result.settled = rest(move.largest, before) <= settled * mesh.spacing;
        to_and_fro
            = pass > 2 && before <= small * mesh.spacing && move.largest > before / 2;
        before = move.largest;
      }
      guess.level_set = frame.moved(move.increment, mesh.spacing);
      guess.front = segments_of(*move.front);
      guess.powers = data.time.powers;
      last = pass == most
             || (moves && pass >= data.fewest_passes && (result.settled || to_and_fro));
      if(!last)
        continue;
      for(const Phase phase : phases)
        result.heat[index(phase)] = stage.heat(phase);
      result.flux = flux;
      result.wall_power = stage.wall_power();
      result.released_power = stage.released_power();
    }
    for(const double power : data.time.powers)
      result.source_power += power;
    result.limited = move.limited;
    result.guess = std::move(guess);
    result.increment = std::move(move.increment);
    result.debt = std::move(move.debt);
    return result;
  }

  namespace
  {
    /** Temperatures after an implicit step of conduction alone. */
    class EvenOut
    {
    public:
      EvenOut(PhaseAssembly &assembly, const StepFrame &frame, const StageTime &time,
              double duration)
        : frame(frame)
        , duration(duration)
      {
        const std::size_t nodes = frame.level_set.size();
        const Guess nothing{{Values(nodes), Values(nodes)}, {}, {}, {}};
        for(const Phase phase : phases)
          operators.push_back(
              assembly.assemble(phase, frame, frame.front, time, nothing, false));
      }

      /** What holds given heat, by phase and hat, with or without flux at the front. */
      LocalVector solve(const std::array<Values, 2> &heat, bool with_front) const
      {
        std::vector<Eigen::Triplet<double>> entries;
        LocalVector load = LocalVector::Zero(frame.unknowns);
        for(const Phase phase : phases)
        {
          const PhaseOperators &terms = operators[index(phase)];
          const std::vector<int> &rows = frame.temperature[index(phase)];
          append(terms.mass, 1, rows, entries);
          append(terms.interior, -duration, rows, entries);
          if(with_front)
            append(terms.front, -duration, rows, entries);
          for(std::size_t node = 0; node < rows.size(); ++node)
            if(rows[node] >= 0)
              load[rows[node]] = heat[index(phase)][node]
                                 + (with_front ? duration * terms.front.constant[node]
                                                     - terms.mass.constant[node]
                                               : 0);
        }
        for(const int row : frame.displacement)
          if(row >= 0)
            entries.emplace_back(row, row, 1.);
        return conservative::solve(frame.unknowns, entries, load);
      }

      std::array<Values, 2> heat(const LocalVector &solution) const
      {
        return {operators[0].mass.apply(solution), operators[1].mass.apply(solution)};
      }

    private:
      const StepFrame &frame;
      const double duration;
      std::vector<PhaseOperators> operators; ///< by Phase
    };
  } // namespace

  Temperatures temperatures_of(PhaseAssembly &assembly, const StepFrame &frame,
                               const StageTime &time, double duration,
                               const std::array<Values, 2> &heat)
  {
    const EvenOut even_out(assembly, frame, time, duration);
    return temperatures(frame, even_out.solve(heat, true));
  }

  Temperatures spread_heat(PhaseAssembly &assembly, const StepFrame &frame,
                           const StageTime &time, double duration,
                           std::array<Values, 2> &heat)
  {
    const EvenOut even_out(assembly, frame, time, duration);
    LocalVector solution = even_out.solve(heat, true);
    std::array<Values, 2> left = even_out.heat(solution);
    for(std::size_t p = 0; p < 2; ++p)
      for(std::size_t node = 0; node < heat[p].size(); ++node)
        left[p][node]
            = frame.temperature[p][node] < 0 ? 0 : heat[p][node] - left[p][node];
    solution += even_out.solve(left, false);
    heat = even_out.heat(solution);
    return temperatures(frame, solution);
  }
} // namespace meltfront::reference_fem::cut::conservative
