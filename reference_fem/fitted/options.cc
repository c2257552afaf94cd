#include <reference_fem/fitted/options.h>

#include <cases/error.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    using cases::DomainShape;
    using cases::Symmetry;

    /** Coarse runs take more steps than the cells call for, so that their fronts can be
     * compared at 50 times at least. */
    constexpr int fewest_steps = 50;

    /** Where walls' data vary in time, jump or swing: with 64 steps 4 of 1000 random
     * slabs are off by 1.5e-6 to 3.4e-6, with 100 by less than 1e-6 (events/README.md).
     */
    constexpr int fewest_steps_of_varying_walls = 100;

    /** In more dimensions a Jacobian is kept for a step or more. Short steps take few
     * iterations each, so that many of them cost no more than few. */
    constexpr int fewest_steps_with_kept_jacobian = 300;
    constexpr int steps_per_cell = 2;
    constexpr int fewest_cells_around = 8;

    int choose_dimension(const cases::Scene &scene, int wanted)
    {
      std::vector<int> possible{scene.domain.dimension};
      const bool radial = scene.symmetry == Symmetry::cylindrical
                          || scene.symmetry == Symmetry::spherical;
      if(radial && scene.domain.shape == DomainShape::box)
        throw cases::Refusal("fem-fitted has no rays from an axis or a centre to the "
                             "walls of a box; it takes a ball or a shell");
      if(radial)
        possible.insert(possible.begin(), 1);
      if(wanted == 0)
        return possible.front();
      if(std::find(possible.begin(), possible.end(), wanted) == possible.end())
        throw cases::Refusal(
            fmt::format("fem-fitted simulates this scene in {} dimensions, not in {}",
                        fmt::join(possible, " or "), wanted));
      return wanted;
    }

    bool walls_vary(const cases::Scene &scene)
    {
      return std::ranges::any_of(scene.boundaries,
                                 [](const std::optional<cases::Boundary> &wall)
                                 {
                                   return wall
                                          && wall->kind != cases::BoundaryKind::insulated
                                          && !wall->exact && !wall->value.constant;
                                 });
    }

    /** What depends on the radius alone is solved the same with any number of them. */
    int choose_cells_around(const cases::Scene &scene, int wanted, int cells)
    {
      if(wanted > 0)
        return wanted;
      return scene.symmetry == Symmetry::none ? std::max(fewest_cells_around, cells)
                                              : fewest_cells_around;
    }
  } // namespace

  RunOptions options_for(const cases::Scene &scene, const cases::Resolution &resolution)
  {
    auto options = cases::read_options(RunOptions(), resolution.options);
    options.dimension = choose_dimension(scene, options.dimension);
    options.scheme = scheme_of(options.scheme_name);
    if(options.refine == Refine::time)
      options.steps = resolution.n;
    else
    {
      options.cells = resolution.n;
      if(options.steps == 0)
        options.steps
            = options.refine == Refine::space
                  ? 200
                  : std::max(options.dimension > 1 ? fewest_steps_with_kept_jacobian
                             : walls_vary(scene)   ? fewest_steps_of_varying_walls
                                                   : fewest_steps,
                             steps_per_cell * resolution.n);
    }
    options.cells_around
        = choose_cells_around(scene, options.cells_around, options.cells);
    return options;
  }

  cases::Demand demand_of(const cases::Scene &scene, const RunOptions &options)
  {
    const cases::Domain &domain = scene.domain;
    const double degree = options.degree;
    const auto nodes_across = [&](double width)
    { return std::max(2., options.cells * width / domain.side()) * degree + 1; };
    const double outer = domain.round() ? domain.radius : domain.upper[0];
    const double inner = domain.round() ? domain.inner_radius : domain.lower[0];
    double rays = 1;
    if(options.dimension > 1 && domain.round())
      rays = options.dimension == 2
                 ? options.cells_around * degree
                 : 6 * std::pow(std::max(1, options.cells_around / 4) * degree, 2);
    else
      for(int d = 1; d < options.dimension; ++d)
        rays *= nodes_across(domain.upper[d] - domain.lower[d]);
    const double unknowns = rays * nodes_across(outer - inner);
    // A row holds what the cells at a node hold and the fronts of their rays.
    const double row = std::pow(degree + 2, options.dimension)
                       + (options.dimension > 1 ? std::pow(degree + 1, 2) : 1);
    // Of factors, real and complex: bands of three stages, or nested dissection.
    const double filled = options.dimension == 1   ? 9 * 3 * row
                          : options.dimension == 2 ? 3 * row * std::log2(unknowns + 2)
                                                   : 3 * row * std::cbrt(unknowns);
    constexpr double number = sizeof(double), index = sizeof(int);
    const double by_row = row * (6 * number + 3 * index) // Jacobians and stage matrices
                          + filled * (number + index) + 40 * number; // states, sites
    constexpr double program = 5e7;
    return {.bytes = program + unknowns * by_row,
            .steps = static_cast<double>(options.steps)};
  }

  void RunOptions::bind(cases::OptionBinder &options)
  {
    options.add("degree", degree, "Degree of the elements.", 1, 4);
    options.add("dimension", dimension,
                "Dimension in which a symmetric scene is simulated; 0: the lowest.", 0,
                3);
    options.add(
        "time_scheme", scheme_name,
        "Time scheme: backward differentiation (bdf2, bdf3, bdf4) or Radau IIA of "
        "order 3 or 5 (radau3, radau5).",
        cases::themselves({"bdf2", "bdf3", "bdf4", "radau3", "radau5"}));
    options.add("steps", steps,
                "Time steps over the run; 0: two for each of the n cells and at least 50 "
                "(100 where walls vary in time, 300 in 2D and 3D), or 200 where only "
                "space is refined.",
                0, 1e7);
    options.add(
        "refine", refine,
        "What n refines: both, space (the steps stay) or time (n steps, the cells "
        "stay).",
        {{"both", Refine::both}, {"space", Refine::space}, {"time", Refine::time}});
    options.add("cells", cells, "Cells along the domain's side where n refines time.", 2,
                1e5);
    options.add("cells_around", cells_around,
                "Cells around a round front in 2D and 3D (4 for each edge of a sphere's "
                "cube); 0: n, at least 8, or 8 where everything depends on the radius "
                "alone.",
                0, 1e5);
    options.add("clock", clock,
                "Steps are equal in t or in sqrt(t); automatic: sqrt(t) for a scene that "
                "starts from an exact solution some time after that began, else t.",
                cases::themselves({"automatic", "t", "sqrt(t)"}));
    options.add("tolerance", tolerance,
                "Error of a time step, relative, that the steps are chosen for (Radau); "
                "0: equal steps.",
                0, 1);
    options.add("grading", grading,
                "Width of a cell over that of its neighbour towards the front, in both "
                "phases.",
                1, 10);
  }
} // namespace meltfront::reference_fem::fitted
