#include <cases/error.h>
#include <particles/level_set/markers/marker_scheme.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace meltfront::particles::level_set
{
  namespace
  {
    const MarkerParameters &checked(const MarkerParameters &parameters)
    {
      if(parameters.correct_every < 1 || parameters.reseed_every < 1)
        throw cases::InputError(fmt::format(
            "markers that correct every {} steps and are reseeded every {}: both must be "
            "above zero",
            parameters.correct_every, parameters.reseed_every));
      if(parameters.threads < 1)
        throw cases::InputError(fmt::format("markers on {} threads: at least 1 is needed",
                                            parameters.threads));
      if(!parameters.interpolative && parameters.reseeding == ReseedingRule::midpoint)
        throw cases::InputError("markers that look for escapes carry no distance that a "
                                "new one between them could take: reseed them from the "
                                "grid or not at all");
      return parameters;
    }

    SeedingParameters seeding_of(const MarkerParameters &parameters)
    {
      SeedingParameters seeding;
      seeding.per_cell = parameters.per_cell;
      seeding.seed = parameters.seed;
      seeding.normals = parameters.interpolative;
      if(!parameters.interpolative)
      {
        // those nearer than the least radius would be spheres that cross the front
        seeding.nearest = 0.1;
        seeding.band = seeding.furthest = 3;
      }
      return seeding;
    }

    ReseedingParameters reseeding_of(const MarkerParameters &parameters)
    {
      ReseedingParameters reseeding;
      reseeding.rule = parameters.reseeding;
      reseeding.seeding = seeding_of(parameters);
      reseeding.most = 4 * parameters.per_cell;
      return reseeding;
    }
  } // namespace

  MarkerParameters MarkerParameters::original()
  {
    MarkerParameters result;
    result.interpolative = false;
    result.per_cell = 64;
    result.reseeding = ReseedingRule::none;
    return result;
  }

  MarkerParameters MarkerParameters::corrected(const EscapeMerge merge)
  {
    MarkerParameters result = original();
    result.escape.rule = EscapeRule::normals;
    result.escape.merge = merge;
    return result;
  }

  MarkerParameters MarkerParameters::interpolating(const int dimension,
                                                   const bool clustered)
  {
    MarkerParameters result;
    result.fit = FitParameters::in(dimension);
    result.fit.clustered = clustered;
    return result;
  }

  MarkerScheme::MarkerScheme(const Grid &grid, const MarkerParameters &parameters,
                             std::string method)
    : grid(grid)
    , parameters(checked(parameters))
    , cells(grid)
    , escapes(grid, parameters.escape, parameters.threads)
    , reseeding(grid, reseeding_of(parameters))
    , motion(std::move(method), parameters.threads)
  {
    all.dimension = grid.dimension();
  }

  void MarkerScheme::seed(const DistanceFunction &distance)
  {
    all = seed_markers(grid, distance, seeding_of(parameters));
    if(!parameters.interpolative)
      for(double &value : all.distance)
        value = signed_radius(value, grid.spacing());
    cells.sort(all);
    done = {};
  }

  Carried MarkerScheme::carried(const cases::VelocityField &velocity) const
  {
    if(!parameters.interpolative)
      return Carried::position;
    if(parameters.carry_distance && !velocity.rigid())
      return Carried::distance_normal;
    return parameters.fit.clustered ? Carried::normal : Carried::position;
  }

  void MarkerScheme::move(const cases::VelocityField &velocity, const TimeStep &step)
  {
    rigid = rigid && velocity.rigid();
    motion.step(all, velocity, step.time, step.length, carried(velocity), step.number);
    done.moved += static_cast<double>(all.size());
  }

  void MarkerScheme::correct(LevelSet &level_set)
  {
    if(parameters.interpolative)
    {
      cells.sort(all);
      const FitCounts counts = fit_level_set(grid, all, cells, parameters.fit,
                                             level_set.values(), parameters.threads);
      done.nodes += static_cast<double>(counts.quadratic + counts.linear + counts.mean);
    }
    else
      done.escaped += static_cast<double>(escapes.correct(all, level_set.values()));
    done.corrections += 1;
    level_set.fill_ghosts();
  }

  void MarkerScheme::refresh(LevelSet &level_set)
  {
    correct(level_set);
    if(!parameters.interpolative)
      escapes.reset_radii(all, level_set.values());
  }

  void MarkerScheme::reseed(const LevelSet &level_set)
  {
    reseeding.apply(all, cells, level_set.values());
    if(!parameters.interpolative)
      for(double &value : all.distance)
        value = signed_radius(value, grid.spacing());
    done.born = static_cast<double>(reseeding.born());
  }

  bool MarkerScheme::corrects_at(const long step) const
  {
    return step % parameters.correct_every == 0;
  }

  bool MarkerScheme::reseeds_at(const long step) const
  {
    return parameters.reseeding != ReseedingRule::none && !rigid
           && step % parameters.reseed_every == 0;
  }
} // namespace meltfront::particles::level_set
