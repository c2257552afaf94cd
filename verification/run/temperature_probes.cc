#include <cases/numbers.h>
#include <cases/sampling.h>
#include <verification/measure/formulas/front_reader.h>
#include <verification/measure/formulas/site_coordinates.h>
#include <verification/run/temperature_probes.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace meltfront::verification
{
  namespace
  {
    using cases::nan;

    constexpr int probes_along_line = 20;
    constexpr std::array<int, 4> probes_along_side{0, 0, 5, 3}; ///< by dimension
    constexpr std::size_t points_of_polynomial = 6;

    /** Ascending coordinates, each once, with their temperature and phase. */
    struct Profile
    {
      std::vector<double> coordinate, temperature, fraction;
      std::vector<bool> solid;
    };

    Profile profile_of(const cases::Snapshot &snapshot,
                       const std::vector<double> &coordinates, double spacing)
    {
      std::vector<double> places(coordinates);
      std::vector<double> temperatures(snapshot.temperature.begin(),
                                       snapshot.temperature.end());
      std::vector<double> fractions(snapshot.solid_fraction.begin(),
                                    snapshot.solid_fraction.end());
      if(snapshot.dimension > 1)
      {
        const Shells shells(coordinates, spacing);
        places = shells.coordinate;
        temperatures = shells.means(snapshot.temperature);
        fractions = shells.means(snapshot.solid_fraction);
      }
      std::vector<std::size_t> order(places.size());
      std::iota(order.begin(), order.end(), 0);
      std::ranges::stable_sort(order, {}, [&](std::size_t i) { return places[i]; });
      Profile profile;
      for(const std::size_t i : order)
        if(profile.coordinate.empty()
           || places[i] > profile.coordinate.back() + 1e-9 * spacing)
        {
          profile.coordinate.push_back(places[i]);
          profile.temperature.push_back(temperatures[i]);
          profile.fraction.push_back(fractions[i]);
          profile.solid.push_back(fractions[i] > 0.5);
        }
      return profile;
    }

    /** Neville's scheme through the points from `first` on. */
    double polynomial(const Profile &profile, std::size_t first, std::size_t points,
                      double place)
    {
      std::vector<double> value(profile.temperature.begin() + first,
                                profile.temperature.begin() + first + points);
      const double *x = profile.coordinate.data() + first;
      for(std::size_t level = 1; level < points; ++level)
        for(std::size_t i = 0; i + level < points; ++i)
          value[i] = ((place - x[i + level]) * value[i] + (x[i] - place) * value[i + 1])
                     / (x[i] - x[i + level]);
      return value[0];
    }

    double temperature_at(const Profile &profile, double place)
    {
      const std::size_t size = profile.coordinate.size();
      if(size == 0)
        return nan;
      const auto above = std::ranges::lower_bound(profile.coordinate, place);
      auto nearest = static_cast<std::size_t>(above - profile.coordinate.begin());
      if(nearest == size
         || (nearest > 0
             && place - profile.coordinate[nearest - 1]
                    < profile.coordinate[nearest] - place))
        --nearest;
      // As many points on either side as its phase allows.
      std::size_t first = nearest, last = nearest;
      const auto may_grow_down = [&]
      { return first > 0 && profile.solid[first - 1] == profile.solid[nearest]; };
      const auto may_grow_up = [&]
      { return last + 1 < size && profile.solid[last + 1] == profile.solid[nearest]; };
      while(last - first + 1 < points_of_polynomial && (may_grow_down() || may_grow_up()))
      {
        const bool down_is_nearer = may_grow_down()
                                    && (!may_grow_up()
                                        || place - profile.coordinate[first - 1]
                                               <= profile.coordinate[last + 1] - place);
        down_is_nearer ? --first : ++last;
      }
      return polynomial(profile, first, last - first + 1, place);
    }

    double fraction_at(const Profile &profile, double place)
    {
      const std::vector<double> &x = profile.coordinate, &f = profile.fraction;
      if(x.empty())
        return nan;
      const auto above = std::ranges::lower_bound(x, place);
      if(above == x.begin())
        return f.front();
      if(above == x.end())
        return f.back();
      const auto i = static_cast<std::size_t>(above - x.begin());
      return f[i - 1] + (f[i] - f[i - 1]) * (place - x[i - 1]) / (x[i] - x[i - 1]);
    }

    std::vector<TemperatureProbe> along_line(const cases::Scene &scene,
                                             const cases::Snapshot &snapshot,
                                             const std::vector<double> &coordinates,
                                             const cases::ExactSolution *exact,
                                             double spacing)
    {
      const bool planar = measured_symmetry(scene, exact) == cases::Symmetry::planar;
      const auto [lower, upper] = coordinate_range(scene, exact);
      const Profile profile = profile_of(snapshot, coordinates, spacing);
      std::vector<TemperatureProbe> probes;
      for(int i = 0; i < probes_along_line; ++i)
      {
        const double place = lower + (i + 0.5) * (upper - lower) / probes_along_line;
        probes.push_back({planar ? "x" : "r",
                          {place},
                          temperature_at(profile, place),
                          exact ? exact->temperature(place, snapshot.time) : nan});
      }
      return probes;
    }

    bool inside(const cases::Domain &domain, const cases::Position &place)
    {
      if(domain.irregular())
        return cases::contains(domain, place);
      if(!domain.round())
        return true;
      const double r = std::hypot(place[0], place[1], place[2]);
      return r >= domain.inner_radius && r < domain.radius;
    }

    std::vector<cases::Position> places_inside(const cases::Domain &domain)
    {
      const int parts = probes_along_side[domain.dimension];
      const auto coordinate = [&](int d, int i)
      {
        const double lower = domain.round() ? -domain.radius : domain.lower[d];
        const double upper = domain.round() ? domain.radius : domain.upper[d];
        return lower + (i + 0.5) * (upper - lower) / parts;
      };
      std::vector<cases::Position> places;
      const int layers = domain.dimension == 3 ? parts : 1;
      for(int k = 0; k < layers; ++k)
        for(int j = 0; j < parts; ++j)
          for(int i = 0; i < parts; ++i)
          {
            const cases::Position place{coordinate(0, i), coordinate(1, j),
                                        domain.dimension == 3 ? coordinate(2, k) : 0};
            if(inside(domain, place))
              places.push_back(place);
          }
      return places;
    }

    /** 1, x, y, ..., x x, x y, ... about a place, in units of the spacing. */
    Eigen::RowVectorXd monomials(const cases::Position &offset, int dimension)
    {
      Eigen::RowVectorXd row(1 + dimension + dimension * (dimension + 1) / 2);
      int column = 0;
      row[column++] = 1;
      for(int d = 0; d < dimension; ++d)
        row[column++] = offset[d];
      for(int d = 0; d < dimension; ++d)
        for(int e = d; e < dimension; ++e)
          row[column++] = offset[d] * offset[e];
      return row;
    }

    PlaceReading fitted(const cases::Snapshot &snapshot, const cases::Position &place,
                        double spacing)
    {
      // In spacings; the larger one where the smaller finds too few, as in corners.
      constexpr double small_reach = 2.5, large_reach = 4;
      const std::size_t sites = snapshot.temperature.size();
      std::vector<cases::Position> offsets(sites);
      std::vector<double> distance(sites);
      for(std::size_t i = 0; i < sites; ++i)
      {
        const cases::Position site = site_position(snapshot, i);
        for(int d = 0; d < snapshot.dimension; ++d)
          offsets[i][d] = (site[d] - place[d]) / spacing;
        distance[i] = std::hypot(offsets[i][0], offsets[i][1], offsets[i][2]);
      }
      if(sites == 0)
        return {nan, nan};
      const auto nearest = static_cast<std::size_t>(std::ranges::min_element(distance)
                                                    - distance.begin());
      const bool solid = snapshot.solid_fraction[nearest] > 0.5;
      double fractions = 0, weights = 0;
      for(std::size_t i = 0; i < sites; ++i)
        if(distance[i] < small_reach)
        {
          fractions += (1 - distance[i] / small_reach) * snapshot.solid_fraction[i];
          weights += 1 - distance[i] / small_reach;
        }
      const auto of_phase_within = [&](double reach)
      {
        std::vector<std::size_t> near;
        for(std::size_t i = 0; i < sites; ++i)
          if(distance[i] < reach && (snapshot.solid_fraction[i] > 0.5) == solid)
            near.push_back(i);
        return near;
      };
      PlaceReading reading{snapshot.temperature[nearest],
                           weights > 0 ? fractions / weights
                                       : snapshot.solid_fraction[nearest]};
      const auto columns = monomials({}, snapshot.dimension).size();
      const auto too_few = [columns](const std::vector<std::size_t> &near)
      { return static_cast<Eigen::Index>(near.size()) < columns; };
      double reach = small_reach;
      std::vector<std::size_t> near = of_phase_within(reach);
      if(too_few(near))
        near = of_phase_within(reach = large_reach);
      if(too_few(near))
        return reading;
      Eigen::MatrixXd rows(near.size(), columns);
      Eigen::VectorXd values(near.size());
      for(std::size_t k = 0; k < near.size(); ++k)
      {
        const double weight = 1 - distance[near[k]] / reach;
        rows.row(k) = weight * monomials(offsets[near[k]], snapshot.dimension);
        values[k] = weight * snapshot.temperature[near[k]];
      }
      reading.temperature = rows.completeOrthogonalDecomposition().solve(values)[0];
      return reading;
    }
  } // namespace

  std::pair<double, double> coordinate_range(const cases::Scene &scene,
                                             const cases::ExactSolution *exact)
  {
    const cases::Domain &domain = scene.domain;
    if(measured_symmetry(scene, exact) == cases::Symmetry::planar)
      return {domain.lower[0], domain.upper[0]};
    return {domain.inner_radius, domain.round() ? domain.radius : domain.side() / 2};
  }

  std::vector<TemperatureProbe> read_probes(const cases::Scene &scene,
                                            const cases::Snapshot &snapshot,
                                            const std::vector<double> &coordinates,
                                            const cases::ExactSolution *exact,
                                            double spacing)
  {
    const bool one_coordinate = scene.symmetry != cases::Symmetry::none
                                || (exact && exact->depends_on_one_coordinate())
                                || scene.domain.dimension == 1;
    if(one_coordinate)
      return along_line(scene, snapshot, coordinates, exact, spacing);
    std::vector<TemperatureProbe> probes;
    for(const cases::Position &place : places_inside(scene.domain))
    {
      TemperatureProbe probe{{},
                             {place.begin(), place.begin() + scene.domain.dimension},
                             fitted(snapshot, place, spacing).temperature,
                             exact ? exact->temperature(place, snapshot.time) : nan};
      probes.push_back(std::move(probe));
    }
    return probes;
  }

  std::vector<PlaceReading> read_places(const cases::Scene &scene,
                                        const cases::Snapshot &snapshot, double spacing,
                                        const std::vector<cases::Position> &places)
  {
    std::vector<PlaceReading> readings;
    if(scene.symmetry == cases::Symmetry::none && scene.domain.dimension > 1)
    {
      for(const cases::Position &place : places)
        readings.push_back(fitted(snapshot, place, spacing));
      return readings;
    }
    const cases::Symmetry symmetry = measured_symmetry(scene, nullptr);
    const auto coordinate = [symmetry](const cases::Position &p)
    { return symmetry == cases::Symmetry::planar ? p[0] : std::hypot(p[0], p[1], p[2]); };
    std::vector<double> coordinates;
    for(std::size_t i = 0; i < snapshot.temperature.size(); ++i)
      coordinates.push_back(coordinate(site_position(snapshot, i)));
    const Profile profile = profile_of(snapshot, coordinates, spacing);
    for(const cases::Position &place : places)
      readings.push_back({temperature_at(profile, coordinate(place)),
                          fraction_at(profile, coordinate(place))});
    return readings;
  }
} // namespace meltfront::verification
