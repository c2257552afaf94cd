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
    /** One linear system of a stage and what its solution says. */
    class StagePass
    {
    public:
      StagePass(PhaseAssembly &assembly, const cases::Scene &scene,
                const StepFrame &frame, const Front &front, const StageData &data,
                const Temperatures &guess, bool coupled)
        : frame(frame)
        , front(front)
        , data(data)
        , coupled(coupled)
        , per_area(data.duration
                   / (scene.material.solid.density * scene.material.latent_heat))
      {
        for(const Phase phase : phases)
          operators.push_back(
              assembly.assemble(phase, frame, front, data.time, guess, coupled));
      }

      void solve(const Values &increment)
      {
        LocalVector load = LocalVector::Zero(frame.unknowns);
        entries.clear();
        for(const Phase phase : phases)
          add_heat(phase, load);
        if(coupled)
          add_front(increment, load);
        else
          hold_front();
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

      void hold_front()
      {
        for(const int row : frame.displacement)
          if(row >= 0)
            entries.emplace_back(row, row, 1.);
      }

      const StepFrame &frame;
      const Front &front;
      const StageData &data;
      const bool coupled;
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
    result.increment = data.increment;
    for(std::size_t node = 0; node < result.increment.size(); ++node)
      if(frame.displacement[node] < 0)
        result.increment[node] = 0;
    result.temperatures = data.guess;
    assembly.forget_stage();
    const int made = frame.has_front() ? passes : 2;
    for(int pass = 0; pass < made; ++pass)
    {
      const Front front(mesh, frame.moved(result.increment, mesh.spacing));
      const bool coupled = pass > 0 && frame.has_front();
      StagePass stage(assembly, scene, frame, front, data, result.temperatures, coupled);
      stage.solve(result.increment);
      result.entries += static_cast<long>(stage.entries.size());
      result.temperatures = temperatures(frame, stage.solution);
      if(coupled)
      {
        result.last_move = add_displacement(frame, front, mesh.spacing, stage.solution,
                                            result.increment);
        result.limited = result.limited || result.last_move > mesh.spacing;
      }
      if(pass + 1 < made)
        continue;
      for(const Phase phase : phases)
        result.heat[index(phase)] = stage.heat(phase);
      result.flux = stage.flux();
      result.wall_power = stage.wall_power();
      result.released_power = stage.released_power();
    }
    for(const double power : data.time.powers)
      result.source_power += power;
    result.level_set = frame.moved(result.increment, mesh.spacing);
    const double per_area
        = data.duration / (scene.material.solid.density * scene.material.latent_heat);
    Values change = data.change;
    for(std::size_t node = 0; node < change.size(); ++node)
      change[node] += per_area * result.flux[node];
    result.debt = debt(frame, Front(mesh, result.level_set), change, result.increment);
    return result;
  }

  Temperatures temperatures_of(PhaseAssembly &assembly, const StepFrame &frame,
                               const StageTime &time, double duration,
                               const std::array<Values, 2> &heat)
  {
    const std::size_t nodes = frame.level_set.size();
    const Temperatures nothing{Values(nodes), Values(nodes)};
    std::vector<Eigen::Triplet<double>> entries;
    LocalVector load = LocalVector::Zero(frame.unknowns);
    for(const Phase phase : phases)
    {
      const PhaseOperators terms
          = assembly.assemble(phase, frame, frame.front, time, nothing, false);
      const std::vector<int> &rows = frame.temperature[index(phase)];
      append(terms.mass, 1, rows, entries);
      append(terms.interior, -duration, rows, entries);
      append(terms.front, -duration, rows, entries);
      for(std::size_t node = 0; node < nodes; ++node)
        if(rows[node] >= 0)
          load[rows[node]] = heat[index(phase)][node] - terms.mass.constant[node]
                             + duration * terms.front.constant[node];
    }
    for(const int row : frame.displacement)
      if(row >= 0)
        entries.emplace_back(row, row, 1.);
    return temperatures(frame, solve(frame.unknowns, entries, load));
  }
} // namespace meltfront::reference_fem::cut::conservative
