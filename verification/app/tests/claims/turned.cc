#include <verification/app/tests/claims/domains.h>
#include <verification/app/tests/claims/turned.h>

#include <utility>

namespace meltfront::verification::claims
{
  namespace
  {
    using cases::Position, cases::Side;

    /** Depth along the axis of what varies across it, radius of what varies along it. */
    constexpr double extent = 0.5;

    void take_coordinate(cases::Field &field, int direction)
    {
      if(field.value)
        field.value = [value = field.value, direction](const Position &p, double time) {
          return value({p[direction], 0, 0}, time);
        };
    }

    /** Whatever the trial says of x holds of a direction, between two of the sides. */
    Trial about_axis(Trial trial, int direction, const Position &lower,
                     const Position &upper, const std::pair<Side, Side> &sides)
    {
      cases::Scene &scene = trial.scene;
      const cases::Scene before = scene;
      scene.symmetry = cases::Symmetry::none;
      scene.domain = {};
      scene.domain.shape = cases::DomainShape::axisymmetric;
      scene.domain.dimension = 2;
      scene.domain.lower = lower;
      scene.domain.upper = upper;
      scene.boundaries = {};
      for(const Side side : {Side::x_min, Side::x_max, Side::y_min, Side::y_max})
        wall(scene, side);
      const auto move_wall = [&](Side from, Side to)
      {
        const auto &boundary = before.boundaries[static_cast<std::size_t>(from)];
        if(boundary)
          wall(scene, to) = *boundary;
        take_coordinate(wall(scene, to).value, direction);
      };
      move_wall(sides.first, direction == 0 ? Side::x_min : Side::y_min);
      move_wall(sides.second, direction == 0 ? Side::x_max : Side::y_max);
      take_coordinate(scene.initial.temperature, direction);
      if(scene.initial.front)
        take_coordinate(*scene.initial.front, direction);
      scene.initial.exact.reset();
      if(scene.volumetric_source)
        take_coordinate(*scene.volumetric_source, direction);
      trial.judge = [judge = trial.judge, direction](EndState end)
      {
        end.positions = {end.positions[direction]};
        return judge(end);
      };
      return trial;
    }

    template <typename Turn>
    EffectTrials both(const EffectTrials &trials, const Turn &turn)
    {
      return {turn(trials.first), turn(trials.second), trials.one_value_only};
    }
  } // namespace

  Trial turned(Trial round)
  {
    const cases::Domain domain = round.scene.domain;
    round.n = 24;
    return about_axis(std::move(round), 0, {domain.inner_radius, 0, 0},
                      {domain.radius, extent, 0}, {Side::inner, Side::outer});
  }

  Trial upright(Trial slab)
  {
    const cases::Domain domain = slab.scene.domain;
    slab.n = 16;
    return about_axis(std::move(slab), 1, {0, domain.lower[0], 0},
                      {extent, domain.upper[0], 0}, {Side::x_min, Side::x_max});
  }

  EffectTrials turned(const EffectTrials &round)
  {
    return both(round, [](const Trial &trial) { return turned(trial); });
  }

  EffectTrials upright(const EffectTrials &slab)
  {
    return both(slab, [](const Trial &trial) { return upright(trial); });
  }
} // namespace meltfront::verification::claims
