#include <cases/error.h>
#include <particles/greenspan/generation.h>
#include <particles/greenspan/motion/bonds.h>
#include <particles/greenspan/motion/motion.h>
#include <particles/greenspan/motion/random_numbers.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::particles::greenspan
{
  namespace
  {
    const double row_height = std::sqrt(0.75); ///< over the spacing

    /** Solids larger than this are refused. */
    constexpr double most_particles = 1e8;

    void require_size(double particles, double spacing)
    {
      if(!(spacing > 0 && std::isfinite(spacing)))
        throw cases::InputError(
            fmt::format("the spacing of a lattice must be positive, not {}", spacing));
      if(!(particles >= 1 && particles <= most_particles))
        throw cases::InputError(fmt::format(
            "a solid of {:g} particles is asked for; it needs 1 to {:g} of them",
            particles, most_particles));
    }

    /** A row centred about x = 0. */
    void add_row(ParticleState &state, int count, int row, double spacing)
    {
      for(int i = 0; i < count; ++i)
        state.add({(i - 0.5 * (count - 1)) * spacing, row * row_height * spacing, 0});
    }

    /** Move everything so that the lowest particle lies at y = 0 exactly. */
    void rest_on_base(ParticleState &state)
    {
      auto &y = state.position[1];
      const double lowest = *std::min_element(y.begin(), y.end());
      for(double &value : y)
        value -= lowest;
    }

    /** Root mean square of the accelerations; the base carries what lies on it and does
     * not let it slide. */
    double residual(const Motion &motion)
    {
      const auto acceleration = motion.accelerations();
      const ParticleState state = motion.state();
      double sum = 0;
      for(std::size_t i = 0; i < state.size(); ++i)
      {
        const double tiny = 1e-3;
        const bool carried = state.position[1][i] < tiny && acceleration[1][i] < 0;
        for(int d = 0; d < state.dimension; ++d)
          if(!carried)
            sum += acceleration[d][i] * acceleration[d][i];
      }
      return std::sqrt(sum / static_cast<double>(state.size()));
    }
  } // namespace

  ParticleState HexagonalLattice::triangle(int base, double spacing)
  {
    require_size(0.5 * base * (base + 1.), spacing);
    ParticleState state;
    for(int row = 0; row < base; ++row)
      add_row(state, base - row, row, spacing);
    return state;
  }

  ParticleState HexagonalLattice::rectangle(int base, int rows, double spacing)
  {
    require_size(rows > 0 && base > 1 ? double(base) * rows : 0, spacing);
    ParticleState state;
    for(int row = 0; row < rows; ++row)
      add_row(state, base - row % 2, row, spacing);
    return state;
  }

  ParticleState HexagonalLattice::disk(double radius, double spacing)
  {
    return within(cases::Outline([radius](double) { return radius; }, {0, 0}), spacing);
  }

  ParticleState HexagonalLattice::within(const cases::Outline &outline, double spacing)
  {
    const auto &lower = outline.lower(), &upper = outline.upper();
    require_size(1 + outline.area() / (row_height * spacing * spacing), spacing);
    const auto number = [](double length, double step)
    { return static_cast<int>(std::ceil(length / step)); };
    const double height = row_height * spacing;
    ParticleState state;
    for(int row = -number(outline.centre()[1] - lower[1], height);
        row <= number(upper[1] - outline.centre()[1], height); ++row)
      for(int i = -number(outline.centre()[0] - lower[0], spacing) - 1;
          i <= number(upper[0] - outline.centre()[0], spacing); ++i)
      {
        const double x = outline.centre()[0] + (i + 0.5 * std::abs(row % 2)) * spacing;
        const double y = outline.centre()[1] + row * height;
        if(outline.inside({x, y, 0}))
          state.add({x, y, 0});
      }
    if(state.size() == 0)
      throw cases::InputError(fmt::format(
          "no particle of a lattice with the spacing {} lies inside the outline",
          spacing));
    rest_on_base(state);
    return state;
  }

  ParticleState HexagonalLattice::close_packed_box(const std::array<int, 3> &cells,
                                                   double spacing)
  {
    require_size(4. * std::max(0, cells[0]) * std::max(0, cells[1])
                     * std::max(0, cells[2]),
                 spacing);
    const double cell = std::numbers::sqrt2 * spacing;
    ParticleState state;
    state.dimension = 3;
    constexpr double corner[4][3]
        = {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
    for(int k = 0; k < cells[2]; ++k)
      for(int j = 0; j < cells[1]; ++j)
        for(int i = 0; i < cells[0]; ++i)
          for(const auto &c : corner)
            state.add({(i + c[0]) * cell, (j + c[1]) * cell, (k + c[2]) * cell});
    return state;
  }

  ParticleState HexagonalLattice::close_packed_ball(double radius, double spacing)
  {
    const double cell = std::numbers::sqrt2 * spacing;
    require_size(16. / 3 * std::numbers::pi * std::pow(radius / cell, 3), spacing);
    const int half = static_cast<int>(std::ceil(radius / (cell / 2)));
    ParticleState state;
    state.dimension = 3;
    for(int k = -half; k <= half; ++k)
      for(int j = -half; j <= half; ++j)
        for(int i = -half; i <= half; ++i)
          if((i + j + k) % 2 == 0 && std::hypot(i, j, k) * cell / 2 <= radius)
            state.add({i * cell / 2, j * cell / 2, k * cell / 2});
    rest_on_base(state);
    return state;
  }

  double scaled_gravity(int rows)
  {
    return 32 * 7. / rows;
  }

  Relaxation Relaxation::for_rows(const PairForce &force, int rows)
  {
    Relaxation relaxation;
    relaxation.force = force;
    const double spacing = force.equilibrium_distance();
    // Longitudinal waves of a hexagonal lattice of springs k: c^2 = 9/8 k spacing^2.
    const double wave_speed = spacing * std::sqrt(1.125 * force.stiffness());
    const double height = std::max(1, rows) * row_height * spacing;
    relaxation.gravity = scaled_gravity(rows);
    relaxation.drag = std::numbers::pi * wave_speed / (2 * height);
    relaxation.duration = std::max(3., 10 / relaxation.drag);
    return relaxation;
  }

  RelaxedSolid relax_on_base(const ParticleState &lattice, const Relaxation &relaxation)
  {
    MotionParameters parameters;
    parameters.force = relaxation.force;
    parameters.time_step = relaxation.time_step;
    parameters.gravity = relaxation.gravity;
    parameters.base = Base{};
    parameters.drag = relaxation.drag;
    parameters.threads = relaxation.threads;
    Motion motion(parameters, lattice);
    if(!(relaxation.duration > 0 && std::isfinite(relaxation.duration)))
      throw cases::InputError(
          fmt::format("a relaxation must take some time, not {}", relaxation.duration));
    motion.advance(std::lround(relaxation.duration / relaxation.time_step));
    RelaxedSolid result;
    result.residual = residual(motion);
    result.state = motion.state();
    const double cutoff = relaxation.force.cutoff;
    const BondGraph before(lattice.dimension, lattice.position, cutoff);
    const BondGraph after(lattice.dimension, result.state.position, cutoff);
    if(after.count() != before.count() || before.shared_with(after) != before.count())
      throw cases::NumericalError(
          "greenspan", motion.step(), motion.time(), "the solid",
          fmt::format("has {} bonds on the base instead of its lattice's {}; the gravity "
                      "of {:g} is too strong for it",
                      after.count(), before.count(), relaxation.gravity));
    result.bonds = after.count();
    result.state.step = 0;
    result.state.staggered = false;
    for(int d = 0; d < lattice.dimension; ++d)
      std::fill(result.state.velocity[d].begin(), result.state.velocity[d].end(), 0);
    return result;
  }

  void set_temperature(ParticleState &state, double temperature, std::uint64_t seed)
  {
    if(!(temperature >= 0 && std::isfinite(temperature)))
      throw cases::InputError(
          fmt::format("a temperature must be zero or more, not {}", temperature));
    RandomNumbers random(seed);
    for(int d = 0; d < state.dimension; ++d)
    {
      double mean = 0;
      for(double &v : state.velocity[d])
      {
        v = std::sqrt(temperature) * random.normal();
        mean += v / static_cast<double>(state.size());
      }
      for(double &v : state.velocity[d])
        v -= mean;
    }
  }
} // namespace meltfront::particles::greenspan
