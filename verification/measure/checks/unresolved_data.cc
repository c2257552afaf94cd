#include <cases/dense_sampling.h>
#include <cases/expression_words.h>
#include <cases/sampling.h>
#include <cases/scene_heat.h>
#include <verification/measure/checks/scene_quadrature.h>
#include <verification/measure/checks/unresolved_data.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace meltfront::verification
{
  namespace
  {
    using cases::Position;

    /** Of the range of all given temperatures. */
    constexpr double narrow_departure = 0.25;

    /** A spacing is halved no more often than that to find one that does. */
    constexpr int most_halvings = 12;

    constexpr int times_of_run = 9;

    /** Spacings within which a tip is one wide: an angle of an eighth or more. */
    constexpr int steps_to_widen = 8;

    /** A temperature that is given at places of a domain, which is flat for a wall, or of
     * the wall that bends about it. */
    struct GivenTemperature
    {
      std::string name;
      const cases::Field &field;
      const cases::Domain &domain;
      std::vector<Position> places;
      std::vector<double> times;
      bool on_bent_wall = false;
    };

    bool varies_in_space(const cases::Field &field)
    {
      return !field.constant && cases::may_depend_on(field.expression, "xyz");
    }

    std::vector<double> times_of(const cases::Scene &scene, const cases::Field &field)
    {
      std::vector<double> times{scene.start_time};
      constexpr double golden = 0.6180339887498949;
      if(cases::may_depend_on(field.expression, "t"))
        for(int i = 1; i < times_of_run; ++i)
          times.push_back(scene.start_time
                          + std::fmod(golden * i, 1.)
                                * (scene.end_time - scene.start_time));
      return times;
    }

    /** Places far enough from most values to be part of a feature. */
    class Feature
    {
    public:
      Feature(const GivenTemperature &given, double range)
        : given(given)
        , least(narrow_departure * range)
      {
        for(const double time : given.times)
          add_places(time);
      }

      /** Where what lies between points one spacing apart departs most. */
      std::optional<Position> narrower_than(double spacing) const
      {
        std::optional<Position> found;
        double largest = least;
        for(const Suspect &suspect : suspects)
          for(int d = 0; d < given.domain.dimension; ++d)
            if(const double departure = departure_of(suspect, d, spacing / 2);
               departure > largest && !widens(suspect, d, spacing))
            {
              largest = departure;
              found = suspect.place;
            }
        return found;
      }

    private:
      struct Suspect
      {
        Position place;
        double time, value;
      };

      void add_places(double time)
      {
        std::vector<double> values;
        for(const Position &place : given.places)
          values.push_back(given.field(place, time));
        std::vector<double> sorted = values;
        const auto middle = sorted.begin() + static_cast<long>(sorted.size() / 2);
        std::ranges::nth_element(sorted, middle);
        for(std::size_t i = 0; i < values.size(); ++i)
          if(std::abs(values[i] - *middle) > least)
            suspects.push_back({given.places[i], time, values[i]});
      }

      /** From the nearer of the values beside a place in one direction, 0 if it lies
       * between them. Beyond the end of a domain lies what is before it. */
      double departure_of(const Suspect &suspect, int d, double distance) const
      {
        if(!varies_in(d))
          return 0;
        std::array<double, 2> departures{};
        std::array<bool, 2> inside{};
        for(const int side : {0, 1})
        {
          const Position beside
              = moved(suspect.place, d, side == 0 ? -distance : distance);
          inside[side] = given.on_bent_wall || lies_in_domain(beside);
          departures[side] = suspect.value - given.field(beside, suspect.time);
        }
        for(const int side : {0, 1})
          if(!inside[side])
            departures[side] = inside[1 - side] ? departures[1 - side] : 0;
        return departures[0] * departures[1] > 0
                   ? std::min(std::abs(departures[0]), std::abs(departures[1]))
                   : 0;
      }

      /** Whether it is the tip of what is wider elsewhere: of a wedge, a disk, or of one
       * side of a step that meets a wall at an angle. Wider within a few spacings, and
       * half as wide half way, so that a thin layer that ends at a body is none. */
      bool widens(const Suspect &suspect, int d, double spacing) const
      {
        if(given.on_bent_wall)
          return false;
        for(int other = 0; other < given.domain.dimension; ++other)
          for(int step = 1; other != d && step <= steps_to_widen; ++step)
            for(const double way : {-step * spacing, step * spacing})
              if(is_as_wide(suspect, moved(suspect.place, other, way), d, spacing)
                 && is_as_wide(suspect, moved(suspect.place, other, way / 2), d,
                               spacing / 2))
                return true;
        return false;
      }

      bool is_as_wide(const Suspect &suspect, const Position &place, int d,
                      double width) const
      {
        if(!lies_in_domain(place))
          return false;
        const Suspect beside{place, suspect.time, given.field(place, suspect.time)};
        return std::abs(beside.value - suspect.value) <= least
               && departure_of(beside, d, width / 2) <= least;
      }

      /** An outline has one direction, along itself. */
      bool varies_in(int d) const
      {
        const cases::Domain &domain = given.domain;
        if(given.on_bent_wall && domain.outline)
          return d == 0;
        return cases::may_depend_on(given.field.expression, std::string(1, "xyz"[d]))
               && !(domain.rectangular() && domain.lower[d] == domain.upper[d]);
      }

      /** By a distance in a direction, and back to the wall if it bends. */
      Position moved(Position place, int d, double distance) const
      {
        const cases::Domain &domain = given.domain;
        if(given.on_bent_wall && domain.outline)
          return domain.outline->at(domain.outline->arc_length_at(place) + distance);
        const double radius = std::hypot(place[0], place[1], place[2]);
        place[d] += distance;
        if(given.on_bent_wall)
        {
          const double scale = radius / std::hypot(place[0], place[1], place[2]);
          for(double &component : place)
            component *= scale;
        }
        return place;
      }

      bool lies_in_domain(const Position &p) const
      {
        if(given.domain.rectangular())
          for(int d = 0; d < given.domain.dimension; ++d)
            if(p[d] < given.domain.lower[d] || p[d] > given.domain.upper[d])
              return false;
        return cases::contains(given.domain, p);
      }

      const GivenTemperature &given;
      double least;
      std::vector<Suspect> suspects;
    };

    constexpr double rounding = 1e-9;

    bool drives_heat(const cases::Scene &scene, cases::Side side)
    {
      const cases::BoundaryKind kind = scene.boundary(side).kind;
      return kind != cases::BoundaryKind::insulated
             && kind != cases::BoundaryKind::periodic;
    }

    /** Of a wall about a centre or an axis that drives heat (m); 0 if there is none. */
    double radius_of_hole(const cases::Scene &scene)
    {
      const cases::Domain &domain = scene.domain;
      if(domain.shape == cases::DomainShape::shell)
        return drives_heat(scene, cases::Side::inner) ? domain.inner_radius : 0;
      if(domain.shape == cases::DomainShape::axisymmetric)
        return drives_heat(scene, cases::Side::x_min) ? domain.lower[0] : 0;
      return 0;
    }

    /** Whether what a box is given may vary in a direction. */
    bool varies_along(const cases::Scene &scene, int d)
    {
      const std::string variable(1, "xyz"[d]);
      const auto varies = [&](const cases::Field &field)
      { return cases::may_vary_with(field, variable); };
      return drives_heat(scene, static_cast<cases::Side>(2 * d))
             || drives_heat(scene, static_cast<cases::Side>(2 * d + 1))
             || !scene.sources.empty() || varies(scene.initial.temperature)
             || (scene.volumetric_source && varies(*scene.volumetric_source))
             || std::ranges::any_of(scene.sides(),
                                    [&](cases::Side side) {
                                      return drives_heat(scene, side)
                                             && varies(scene.boundary(side).value);
                                    });
    }

    std::string describe(const GivenTemperature &given, double range, double spacing)
    {
      const Feature feature(given, range);
      const std::optional<Position> place = feature.narrower_than(spacing);
      if(!place)
        return "";
      double finer = spacing;
      for(int i = 0; i < most_halvings && feature.narrower_than(finer); ++i)
        finer /= 2;
      return fmt::format(
          "{} has a feature at ({:.4g}, {:.4g}, {:.4g}) that is narrower "
          "than the spacing of {:.3g} m; {:.3g} m or less would resolve it",
          given.name, (*place)[0], (*place)[1], (*place)[2], spacing, finer);
    }
  } // namespace

  std::string unresolved_data(const cases::Scene &scene, double spacing)
  {
    const cases::TemperatureBounds bounds = cases::given_temperatures(scene);
    const double range = bounds.upper - bounds.lower;
    if(!(range > 0) || !std::isfinite(range))
      return "";
    const cases::Field &initial = scene.initial.temperature;
    if(!scene.initial.exact && initial.value && initial.expression != "exact"
       && varies_in_space(initial))
    {
      GivenTemperature given{
          "the initial temperature", initial, scene.domain, {}, {scene.start_time}};
      cases::visit_densely(scene, {&initial},
                           [&](const Position &p) { given.places.push_back(p); });
      if(const std::string found = describe(given, range, spacing); !found.empty())
        return found;
    }
    for(const cases::Side side : scene.sides())
    {
      const cases::Boundary &boundary = scene.boundary(side);
      if(!cases::gives_temperature(boundary) || !varies_in_space(boundary.value))
        continue;
      const cases::Domain wall = scene.domain.rectangular()
                                     ? cases::wall_of(scene.domain, side)
                                     : scene.domain;
      std::vector<Position> places;
      cases::visit_wall_densely(scene, side, boundary.value,
                                [&](const Position &p) { places.push_back(p); });
      const GivenTemperature given{
          fmt::format("the temperature that is given at {}", name_of(scene.domain, side)),
          boundary.value,
          wall,
          std::move(places),
          times_of(scene, boundary.value),
          scene.domain.round() || scene.domain.outline};
      if(const std::string found = describe(given, range, spacing); !found.empty())
        return found;
    }
    return "";
  }

  std::string unresolved_walls(const cases::Scene &scene, double spacing, double width)
  {
    const cases::Domain &domain = scene.domain;
    // One cell across would be as thick as the shell, whatever n asks for.
    if(const double thickness = domain.radius - domain.inner_radius;
       domain.shape == cases::DomainShape::shell && thickness < 2 * width * (1 - rounding)
       && (drives_heat(scene, cases::Side::inner)
           || drives_heat(scene, cases::Side::outer)))
      return fmt::format(
          "the shell is {:.3g} m thick, less than two spacings of {:.3g} m; "
          "n has to be larger",
          thickness, width);
    if(const double diameter = 2 * radius_of_hole(scene);
       diameter > 0 && diameter < width * (1 - rounding))
      return fmt::format(
          "the inner wall is {:.3g} m across, less than the {:.3g} m that a "
          "spacing of {:.3g} m resolves; n has to be {:.3g} times as large "
          "at least",
          diameter, width, spacing, width / diameter);
    if(!domain.rectangular())
      return "";
    for(int d = 0; d < domain.dimension; ++d)
    {
      const double across = domain.upper[d] - domain.lower[d];
      if(across < spacing * (1 - rounding) && varies_along(scene, d))
        return fmt::format("the domain is {:.3g} m wide along {}, less than the spacing "
                           "of {:.3g} m; n has to be {:.3g} times as large at least",
                           across, "xyz"[d], spacing, spacing / across);
    }
    return "";
  }
} // namespace meltfront::verification
