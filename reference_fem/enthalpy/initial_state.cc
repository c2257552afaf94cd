#include <cases/exact/heat_quadrature.h>
#include <cases/expression_words.h>
#include <cases/initial_level.h>
#include <cases/mean_with_jumps.h>
#include <reference_fem/enthalpy/initial_state.h>

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace meltfront::reference_fem
{
  namespace
  {
    using cases::Position;
    using cases::Symmetry;

    /** Parts and halvings of them in search of what jumps along a line. */
    constexpr int parts_of_line = 4, halvings_of_line = 12;

    /** What the averages are made of: the front, where there is one, decides on the
     * phase, not the sign of a temperature that may be the melting point's. */
    class Start
    {
    public:
      Start(const cases::Scene &scene, const std::optional<cases::Field> &front)
        : scene(scene)
        , front(front)
        , jumps(!scene.initial.exact
                && cases::may_jump_with(scene.initial.temperature.expression, "xyz"))
      {
      }

      /** Whether nodes take averages, or values where they are. */
      bool averaged() const
      {
        return front || jumps;
      }

      /** Whether the temperature may jump elsewhere than at the front. */
      bool may_jump() const
      {
        return jumps;
      }

      /** Enthalpy per volume at a point. */
      double operator()(const Position &p) const
      {
        return front ? enthalpy(p, solid(p)) : at_node(p);
      }

      /** The same where the material's own law is taken at a point. */
      double at_node(const Position &p) const
      {
        return scene.material.solid.density
               * scene.material.enthalpy(scene.initial.temperature(p, scene.start_time),
                                         front ? double(solid(p))
                                               : scene.initial.solid_fraction_at_melting);
      }

      bool solid(const Position &p) const
      {
        return front && (*front)(p, scene.start_time) < 0;
      }

      /** Average between two coordinates on the axis of x with the measure of a symmetry,
       * each phase integrated up to the front. */
      double average(Symmetry measure, double lower, double upper) const
      {
        if(jumps)
        {
          // Over the volume, so that what is uniform stays as it is.
          const double power = measure == Symmetry::spherical     ? 3
                               : measure == Symmetry::cylindrical ? 2
                                                                  : 1;
          return cases::mean_with_jumps(
              [&](double volume) {
                return (*this)({std::pow(volume, 1 / power), 0, 0});
              },
              std::pow(lower, power), std::pow(upper, power), parts_of_line,
              halvings_of_line);
        }
        const double split = front_between(lower, upper);
        return (integral(measure, lower, split) + integral(measure, split, upper))
               / cases::volume_between(measure, lower, upper);
      }

    private:
      double level(double x) const
      {
        return (*front)({x, 0, 0}, scene.start_time);
      }

      double enthalpy(const Position &p, bool solid) const
      {
        const cases::Material &material = scene.material;
        const double temperature = scene.initial.temperature(p, scene.start_time);
        const double excess = temperature - material.melting_temperature;
        if(material.curves)
        {
          const double jump = material.curves->jump();
          if(jump > 0 && (solid ? excess >= 0 : excess <= 0))
            return material.solid.density * (solid ? 0 : jump);
          return material.solid.density * material.enthalpy(temperature);
        }
        if(solid)
          return material.solid.volumetric_heat_capacity() * std::min(excess, 0.);
        return material.solid.density * material.latent_heat
               + material.liquid.volumetric_heat_capacity() * std::max(excess, 0.);
      }

      /** By bisection; the upper end where the front is elsewhere. */
      double front_between(double lower, double upper) const
      {
        const bool solid_below = level(lower) < 0;
        if(solid_below == (level(upper) < 0))
          return upper;
        for(double width = upper - lower;
            width > 1e-15 * std::max(std::abs(lower), std::abs(upper)); width /= 2)
        {
          const double middle = (lower + upper) / 2;
          (solid_below == (level(middle) < 0) ? lower : upper) = middle;
        }
        return upper;
      }

      double integral(Symmetry measure, double from, double to) const
      {
        if(from >= to)
          return 0;
        const bool solid = level((from + to) / 2) < 0;
        return boost::math::quadrature::gauss<double, 7>::integrate(
            [&](double x) {
              return cases::surface(measure, x) * enthalpy({x, 0, 0}, solid);
            },
            from, to);
      }

      const cases::Scene &scene;
      const std::optional<cases::Field> &front;
      bool jumps;
    };

    /** The level set of the front at the start, where the scene has one. */
    std::optional<cases::Field> initial_front(const cases::Scene &scene)
    {
      const auto &exact = scene.initial.exact;
      // At its own start the front of a similarity solution is at the origin.
      const bool begins = exact && !(scene.start_time > exact->start_time())
                          && exact->depends_on_one_coordinate()
                          && !(exact->front(scene.start_time) > 0);
      if(!(scene.material.latent_heat > 0) || begins)
        return {};
      // Of a front of any shape the phase is at hand, and its distance takes a search.
      if(exact && !exact->depends_on_one_coordinate() && !exact->mushy())
        return cases::Field{"exact", [exact](const Position &p, double time)
                            { return 0.5 - exact->solid_fraction(p, time); }};
      if(scene.initial.front || !exact)
        return scene.initial.front;
      return cases::exact_level(exact);
    }

    /** The same where the scene has none, but its temperature passes the melting one
     * between two nodes; what is at it must be one phase. */
    std::optional<cases::Field> temperature_front(const cases::Scene &scene,
                                                  const Mesh &mesh,
                                                  const Discretisation &discretisation)
    {
      const double at_melting = scene.initial.solid_fraction_at_melting;
      if(!scene.changes_phase() || scene.alloy || (at_melting > 0 && at_melting < 1))
        return {};
      cases::Field level = cases::initial_level(scene);
      bool solid = false, liquid = false;
      for(const Position &p : discretisation.positions)
        (level(p, scene.start_time) < 0 ? solid : liquid) = true;
      solid = mesh.anywhere(solid);
      liquid = mesh.anywhere(liquid);
      if(!solid || !liquid)
        return {};
      return level;
    }

    std::vector<double> averages(const cases::Scene &scene, const Start &start,
                                 const Mesh &mesh, const Discretisation &discretisation)
    {
      const std::size_t n = discretisation.volume.size();
      const Symmetry measure = discretisation.measure;
      const double half = discretisation.spacing / 2;
      if(measure == Symmetry::none && scene.domain.shape != cases::DomainShape::slab)
        return mesh.node_averages(
            start, [&](const Position &p) { return start.solid(p); }, start.may_jump());
      std::vector<double> result(n);
      double lower = scene.domain.inner_radius;
      double volume = cases::volume_between(measure, 0, lower);
      for(std::size_t i = 0; i < n; ++i)
        if(measure == Symmetry::none)
        {
          const double x = discretisation.positions[i][0];
          result[i]
              = start.average(Symmetry::planar, std::max(x - half, scene.domain.lower[0]),
                              std::min(x + half, scene.domain.upper[0]));
        }
        else
        {
          volume += discretisation.volume[i];
          const double upper = cases::enclosing_coordinate(measure, volume);
          result[i] = start.average(measure, lower, upper);
          lower = upper;
        }
      return result;
    }
  } // namespace

  std::vector<double> initial_enthalpy(const cases::Scene &scene, const Mesh &mesh,
                                       const Discretisation &discretisation,
                                       const std::vector<char> &free)
  {
    const std::size_t n = discretisation.volume.size();
    std::optional<cases::Field> front = initial_front(scene);
    if(!front && !scene.initial.exact)
      front = temperature_front(scene, mesh, discretisation);
    const Start start(scene, front);
    std::vector<double> result = start.averaged()
                                     ? averages(scene, start, mesh, discretisation)
                                     : std::vector<double>(n);
    for(std::size_t i = 0; i < n; ++i)
      if(!start.averaged() || !free[i])
        result[i] = start.at_node(discretisation.positions[i]);
    return result;
  }
} // namespace meltfront::reference_fem
