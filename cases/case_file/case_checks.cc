#include <cases/case_file/alloy_reader.h>
#include <cases/case_file/case_checks.h>
#include <cases/case_file/key_builders.h>
#include <cases/sampling.h>
#include <cases/wall_law.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::cases
{
  namespace
  {
    constexpr int times_sampled = 16;

    double sampled_time(const Scene &scene, int i)
    {
      return scene.start_time + (scene.end_time - scene.start_time) * i / times_sampled;
    }

    /** Points at a distance from the origin, in all directions of the axes. */
    std::vector<Position> directions(const Domain &domain, double radius)
    {
      std::vector<Position> points;
      for(int d = 0; d < domain.dimension; ++d)
        for(const double sign : {1., -1.})
        {
          Position p{};
          p[d] = sign * radius;
          points.push_back(p);
        }
      return points;
    }

    /** A grid of points between two shares (0 to 1) of every side of a slab or box. */
    std::vector<Position> grid(const Domain &domain, const std::array<double, 3> &from,
                               const std::array<double, 3> &to)
    {
      constexpr int across = 5;
      std::array<int, 3> count{1, 1, 1};
      for(int d = 0; d < domain.dimension; ++d)
        count[d] = from[d] == to[d] ? 1 : across;
      std::vector<Position> points;
      Position p{};
      for(int i = 0; i < count[0] * count[1] * count[2]; ++i)
      {
        const std::array<int, 3> index{i % count[0], i / count[0] % count[1],
                                       i / (count[0] * count[1])};
        for(int d = 0; d < domain.dimension; ++d)
        {
          const double share = from[d] + (to[d] - from[d]) * index[d] / (across - 1);
          p[d] = domain.lower[d] + share * (domain.upper[d] - domain.lower[d]);
        }
        points.push_back(p);
      }
      return points;
    }

    /** A radius at a share (0 to 1) of the way across a ball or a shell. */
    double radius_at(const Domain &domain, double share)
    {
      return domain.inner_radius + share * (domain.radius - domain.inner_radius);
    }

    /** The radius of a round wall. */
    double wall_radius(const Domain &domain, Side side)
    {
      return side == Side::inner ? domain.inner_radius : domain.radius;
    }

    constexpr int points_of_outline = 64;

    /** Of many points some that are spread over them. */
    std::vector<Position> spread_over(const std::vector<Position> &points)
    {
      constexpr std::size_t wanted = 256;
      std::vector<Position> result;
      for(std::size_t i = 0; i < points.size(); i += points.size() / wanted + 1)
        result.push_back(points[i]);
      return result;
    }

    std::vector<Position> interior_points(const Domain &domain)
    {
      if(domain.outline)
      {
        std::vector<Position> points = domain.outline->points(points_of_outline);
        for(const Position &p : grid(domain, {0.03, 0.03, 0.03}, {0.97, 0.97, 0.97}))
          if(domain.outline->inside(p))
            points.push_back(p);
        return points;
      }
      if(domain.mesh)
        return spread_over(domain.mesh->vertices());
      if(!domain.round())
        return grid(domain, {0.03, 0.03, 0.03}, {0.97, 0.97, 0.97});
      std::vector<Position> points;
      for(const double share : {0.03, 0.25, 0.5, 0.75, 0.97})
        for(const Position &p : directions(domain, radius_at(domain, share)))
          points.push_back(p);
      return points;
    }

    std::vector<Position> wall_points(const Domain &domain, Side side)
    {
      if(domain.outline)
        return domain.outline->points(points_of_outline);
      if(domain.mesh)
      {
        std::vector<Position> points;
        visit_wall(domain, side, [&points](const Position &p) { points.push_back(p); });
        return spread_over(points);
      }
      if(domain.round())
        return directions(domain, wall_radius(domain, side));
      std::array<double, 3> from{0, 0, 0}, to{1, 1, 1};
      const int d = static_cast<int>(side) / 2;
      from[d] = to[d] = static_cast<int>(side) % 2;
      return grid(domain, from, to);
    }

    std::string point_text(const Domain &domain, const Position &p)
    {
      std::string text;
      for(int d = 0; d < domain.dimension; ++d)
        text += fmt::format("{}{} = {:.6g}", d == 0 ? "" : ", ", "xyz"[d], p[d]);
      return text;
    }

    /** What radiates, and what is radiated at, is warmer than absolute zero. */
    void check_absolute(const PrmFile &prm, const Scene &scene, Side side,
                        const Position &p, double time)
    {
      const Boundary &wall = scene.boundary(side);
      for(const double temperature :
          {wall.value(p, time), scene.initial.temperature(p, scene.start_time)})
        if(!(temperature > wall.absolute_zero))
          throw prm.error(wall_keys(scene.domain, side), "absolute zero",
                          fmt::format("is {:.6g}, and the wall radiates between "
                                      "temperatures of which one is {:.6g}",
                                      wall.absolute_zero, temperature));
    }

    /** Values at points that a symmetric scene cannot tell apart must agree. */
    void check_symmetric(const PrmFile &prm, const Scene &scene, const Field &field,
                         double radius, double time, const std::string &here,
                         const std::string &key)
    {
      double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
      for(const Position &p : directions(scene.domain, radius))
      {
        lowest = std::min(lowest, field(p, time));
        highest = std::max(highest, field(p, time));
      }
      if(highest - lowest > 1e-9 * std::max(std::abs(highest), std::abs(lowest)))
        throw prm.error(here, key,
                        fmt::format("contradicts the scene's {} symmetry: it ranges from "
                                    "{:.6g} to {:.6g} at the distance {:.6g}",
                                    prm.get_text("Scene", "symmetry"), lowest, highest,
                                    radius));
    }

    void check_finite(const PrmFile &prm, const Scene &scene, const Field &field,
                      const Position &p, double time, const std::string &here,
                      const std::string &key)
    {
      if(!std::isfinite(field(p, time)))
        throw prm.error(here, key,
                        fmt::format("is {} at {}, t = {:.6g}", field(p, time),
                                    point_text(scene.domain, p), time));
    }

    /** Largest difference between the temperatures that the scene itself names; without
     * a front, that its exact solution has. */
    double temperature_span(const Scene &scene, const ExactSolution &exact)
    {
      double lowest = scene.material.melting_temperature, highest = lowest;
      const auto include = [&](double temperature)
      {
        lowest = std::min(lowest, temperature);
        highest = std::max(highest, temperature);
      };
      for(const Position &p : interior_points(scene.domain))
        if(exact.has_front())
          include(scene.initial.temperature(p, scene.start_time));
        else
          for(int i = 0; i <= times_sampled; ++i)
            include(exact.temperature(p, sampled_time(scene, i)));
      for(const Side side : scene.sides())
        if(scene.boundary(side).kind == BoundaryKind::fixed_temperature)
          for(const Position &p : wall_points(scene.domain, side))
            for(int i = 1; i <= times_sampled; ++i)
              include(scene.boundary(side).value(p, sampled_time(scene, i)));
      return highest - lowest;
    }

    /** Checks one exact solution against the scene that it is to solve. */
    class ExactCheck
    {
    public:
      ExactCheck(const PrmFile &prm, const Case &c)
        : prm(prm)
        , scene(c.scene)
        , exact(*c.exact)
        , span(temperature_span(c.scene, *c.exact))
      {
      }

      void initial_state() const
      {
        const double time = scene.start_time;
        for(const Position &p : interior_points(scene.domain))
          compare(exact.temperature(p, time), scene.initial.temperature(p, time), p, time,
                  initial_keys, "temperature");
      }

      /** The level set that the file gives has the sign of the exact front's. */
      void initial_front() const
      {
        if(!scene.initial.front)
          return;
        const double time = scene.start_time;
        for(const Position &p : interior_points(scene.domain))
        {
          const double distance
              = (exact.solid_at_origin() ? 1 : -1) * exact.signed_distance(p, time);
          const double given = (*scene.initial.front)(p, time);
          if(given * distance < 0)
            throw prm.error(initial_keys, "front",
                            fmt::format("contradicts the exact solution, which is {} at "
                                        "{}, t = {:.6g}",
                                        distance < 0 ? "solid" : "liquid",
                                        point_text(scene.domain, p), time));
        }
      }

      void dirichlet_wall(Side side) const
      {
        const Boundary &boundary = scene.boundary(side);
        for(const Position &p : wall_points(scene.domain, side))
          for(int i = 1; i <= times_sampled; ++i)
          {
            const double time = sampled_time(scene, i);
            compare(exact.temperature(p, time), boundary.value(p, time), p, time,
                    wall_keys(scene.domain, side), "temperature");
          }
      }

      /** Late in the run only: early on, layers are thinner than the difference's step.
       */
      void heated_wall(Side side) const
      {
        const Boundary &boundary = scene.boundary(side);
        if(scene.domain.irregular())
          throw prm.error(
              wall_keys(scene.domain, side), "kind",
              "lets a flux through an outline or a mesh, which no exact solution is "
              "held against: 'front floor' in subsection 'Measure' says by "
              "how much it is off");
        for(const Position &p : wall_points(scene.domain, side))
          for(int i = times_sampled / 4; i <= times_sampled; ++i)
          {
            const double time = sampled_time(scene, i);
            const double wanted = wanted_flux(boundary, p, time);
            const double found = flux(side, p, time);
            const double conductivity = conductivity_at(p, time);
            if(!(std::abs(found - wanted)
                 <= 1e-3 * conductivity * span / scene.domain.side()))
              complain(found, wanted, "heat flux", p, time, wall_keys(scene.domain, side),
                       "kind");
          }
      }

    private:
      double wanted_flux(const Boundary &boundary, const Position &p, double time) const
      {
        return heat_through(boundary, p, time, exact.temperature(p, time)).flux;
      }

      double conductivity_at(const Position &p, double time) const
      {
        if(!scene.changes_phase())
          return scene.conductivity_at(p);
        const Material &material = scene.material;
        return (exact.temperature(p, time) < material.melting_temperature
                    ? material.solid
                    : material.liquid)
            .conductivity;
      }

      /** k dT/dn with the outward normal n, from a one-sided difference of order 2. */
      double flux(Side side, const Position &p, double time) const
      {
        const double step = 1e-4 * scene.domain.side();
        const auto inward = [&](double distance)
        {
          Position q = p;
          if(scene.domain.round())
            for(double &x : q)
              x *= 1
                   - (side == Side::outer ? distance : -distance)
                         / wall_radius(scene.domain, side);
          else
            q[static_cast<int>(side) / 2]
                += static_cast<int>(side) % 2 == 0 ? distance : -distance;
          return exact.temperature(q, time);
        };
        return conductivity_at(p, time)
               * (3 * inward(0) - 4 * inward(step) + inward(2 * step)) / (2 * step);
      }

      void compare(double found, double wanted, const Position &p, double time,
                   const std::string &here, const std::string &key) const
      {
        if(!(std::abs(found - wanted) <= 1e-6 * span))
          complain(found, wanted, "temperature", p, time, here, key);
      }

      [[noreturn]] void complain(double found, double wanted, const char *what,
                                 const Position &p, double time, const std::string &here,
                                 const std::string &key) const
      {
        throw prm.error(
            here, key,
            fmt::format("contradicts the exact solution, whose {} is {:.6g} and not "
                        "{:.6g} at {}, t = {:.6g}; a solution that holds approximately "
                        "needs 'front floor' in subsection 'Measure'",
                        what, found, wanted, point_text(scene.domain, p), time));
      }

      const PrmFile &prm;
      const Scene &scene;
      const ExactSolution &exact;
      double span;
    };
  } // namespace

  const char *value_key(const Boundary &boundary)
  {
    switch(boundary.kind)
    {
    case BoundaryKind::flux:
      return "flux";
    case BoundaryKind::heat_transfer:
    case BoundaryKind::radiation:
      return "ambient temperature";
    default:
      return "temperature";
    }
  }

  std::vector<Position> sample_points(const Domain &domain)
  {
    return interior_points(domain);
  }

  void check_fields(const PrmFile &prm, const Scene &scene)
  {
    const bool round = scene.domain.round() && scene.symmetry != Symmetry::none;
    const double start = scene.start_time;
    const auto check_initial = [&](const Field &field, const std::string &key)
    {
      for(const Position &p : interior_points(scene.domain))
        check_finite(prm, scene, field, p, start, initial_keys, key);
      if(round)
        for(const double share : {0.25, 0.5, 0.97})
          check_symmetric(prm, scene, field, radius_at(scene.domain, share), start,
                          initial_keys, key);
    };
    if(scene.conducts_heat())
      check_initial(scene.initial.temperature, "temperature");
    if(scene.initial.front)
      check_initial(*scene.initial.front, "front");
    for(std::size_t s = 0; s < scene.initial.concentration.size(); ++s)
      check_initial(scene.initial.concentration[s], concentration_key(s));
    for(const Side side : scene.sides())
    {
      const Boundary &boundary = scene.boundary(side);
      if(!boundary.value.value)
        continue;
      for(int i = 0; i <= times_sampled; ++i)
      {
        const double time = sampled_time(scene, i);
        for(const Position &p : wall_points(scene.domain, side))
        {
          check_finite(prm, scene, boundary.value, p, time, wall_keys(scene.domain, side),
                       value_key(boundary));
          if(boundary.kind == BoundaryKind::radiation)
            check_absolute(prm, scene, side, p, time);
        }
        if(round)
          check_symmetric(prm, scene, boundary.value, wall_radius(scene.domain, side),
                          time, wall_keys(scene.domain, side), value_key(boundary));
      }
    }
  }

  void check_exact_solution(const PrmFile &prm, const Case &c)
  {
    if(!c.exact)
    {
      prm.forbid("Measure", "front floor", "there is no exact solution");
      return;
    }
    if(c.exact->start_time() > c.scene.start_time)
      throw prm.error("Scene", "start time",
                      fmt::format("comes before the exact solution begins ({})",
                                  c.exact->start_time()));
    if(c.measurement.front_floor > 0)
      return;
    const ExactCheck check(prm, c);
    // A steady scene has no start; what starts as the exact solution need not be
    // compared.
    if(!c.scene.initial.exact && c.scene.problem != ProblemKind::poisson)
    {
      check.initial_state();
      check.initial_front();
    }
    for(const Side side : c.scene.sides())
      switch(c.scene.boundary(side).kind)
      {
      case BoundaryKind::fixed_temperature:
        if(!c.scene.boundary(side).exact)
          check.dirichlet_wall(side);
        break;
      case BoundaryKind::periodic:
        break;
      default:
        if(!c.scene.boundary(side).exact)
          check.heated_wall(side);
      }
  }
} // namespace meltfront::cases
