#include <cases/error.h>
#include <cases/overshoot.h>
#include <verification/measure/front_phases.h>
#include <verification/measure/scene_quadrature.h>
#include <verification/measure/site_coordinates.h>
#include <verification/measure/snapshot_checks.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();

    /** Relative to the largest temperature: what is nearer is the same, of solutions of
     * systems that are rounded in thousands of steps (cases::temperature_round_off()). */
    constexpr double same_temperature = 1e-9;

    /** A front that is to be resolved bends no more than a body this many spacings
     * across. */
    constexpr double smallest_body = 4;

    /** Within so many spacings of a wall or a source a front begins there. */
    constexpr double spacings_to_origin = 2;

    /** Relative to the heat at hand: what is summed in another order. */
    constexpr double sum_of_round_off = 1e-9;

    /** The same of an alloy: crystals and liquid of a site differ a little in
     * temperature, and the site has the mean of both. */
    constexpr double site_of_two_temperatures = 1e-3;

    /** And the published exchange between them loses some thousandths of the heat. */
    constexpr double exchange_of_populations = 1e-2;

    /** Relative to what enters and leaves: sums over many steps. */
    constexpr double integral_of_round_off = 1e-6;

    /** Spacings: sites in disorder sample a release at places that far from the middles
     * of what they stand for, on either side. */
    constexpr double spacings_of_sampling = 2;

    /** Spacings: at two walls and on both sides of a front. */
    constexpr double layers_unaccounted_for = 4;

    /** Share of the domain in a layer one spacing thick along its walls: as much may lie
     * between a curved wall and the volumes of the sites at it. */
    double layer_of_walls(const cases::Scene &scene, double spacing)
    {
      double area = 0;
      for(const cases::Side side : scene.sides())
        area += area_of(scene.domain, side);
      return spacing * area / volume_of(scene.domain);
    }

    /** A mesh has straight cells along a wall that bends. */
    bool meshes_curve(const cases::Scene &scene)
    {
      return scene.symmetry == cases::Symmetry::none
             && (scene.domain.round() || scene.domain.outline);
    }

    std::string place_text(const cases::Position &place, int dimension)
    {
      std::string text;
      for(int d = 0; d < dimension; ++d)
        text += fmt::format("{}{:.6g}", d == 0 ? "" : ", ", place[d]);
      return dimension == 1 ? "x = " + text : "(" + text + ")";
    }

    /** A scene's bounds, and with capillarity those that follow from the temperature of
     * its fronts. */
    cases::TemperatureBounds bounds_of(const cases::Scene &scene, double capillary_shift)
    {
      if(capillary_shift == 0)
        return cases::temperature_bounds(scene);
      cases::Scene straight = scene;
      straight.material.gibbs_thomson_coefficient = 0;
      cases::TemperatureBounds bounds = cases::temperature_bounds(straight);
      const double melting = scene.material.melting_temperature;
      bounds.lower = std::min(bounds.lower, melting - capillary_shift);
      bounds.upper = std::max(bounds.upper, melting + capillary_shift);
      return bounds;
    }
  } // namespace

  SnapshotChecks::SnapshotChecks(const cases::Scene &scene,
                                 const cases::Capabilities &capabilities,
                                 const std::string &method, double spacing)
    : scene(scene)
    , capabilities(capabilities)
    , method(method)
    , spacing(spacing)
    , finder(scene, spacing)
    , given(scene)
    , lowest_seen(infinity)
    , highest_seen(-infinity)
    , capillary_shift(scene.material.gibbs_thomson_coefficient
                      * (std::max(scene.domain.dimension, 2) - 1) * 2
                      / (smallest_body * spacing))
    , entries{{.name = "phase against temperature"},
              {.name = "maximum principle"},
              {.name = "heat of sites"},
              {.name = "heat balance"},
              {.name = "heat of walls",
               .bound = given.walls_vary || meshes_curve(scene)
                            ? spacing / scene.domain.side()
                            : integral_of_round_off},
              {.name = "heat of sources",
               .bound = sites_are_cut() ? layer_of_walls(scene, spacing)
                        : given.sources_vary
                            ? spacings_of_sampling * spacing / scene.domain.side()
                            : integral_of_round_off},
              {.name = "front against phases"}}
  {
    principle_bounds = bounds_of(scene, capillary_shift);
    if(!scene.changes_phase())
      entries[phase].reason = entries[front].reason = "no phase changes";
    else if(const char *metastable = cases::metastable_initial_phase(scene))
      entries[phase].reason = metastable;
    entries[heat_of_walls].reason = given.unknown_walls;
    entries[heat_of_sources].reason = given.unknown_sources;
    if(scene.problem == cases::ProblemKind::poisson)
      entries[heat_of_sites_].reason = entries[balance].reason
          = "a steady state stores nothing";
  }

  const cases::TemperatureBounds &SnapshotChecks::bounds() const
  {
    return principle_bounds;
  }

  void SnapshotChecks::judge(const cases::Snapshot &snapshot)
  {
    require_finite(snapshot);
    if(snapshot.step == 0 && scene.problem != cases::ProblemKind::poisson)
      include_initial(snapshot);
    const auto [lowest, highest] = std::ranges::minmax(snapshot.temperature);
    lowest_seen = std::min(lowest_seen, lowest);
    highest_seen = std::max(highest_seen, highest);
    tracks_front |= !snapshot.front[0].empty();
    entries[principle].bound
        = snapshot.obeys_maximum_principle
              ? cases::overshoot_of_round_off
              : cases::allowed_overshoot(capabilities.overshoot, spacing, scene.domain);
    entries[heat_of_sites_].bound = sites_are_cut() ? layer_of_walls(scene, spacing)
                                    : scene.alloy   ? site_of_two_temperatures
                                                    : sum_of_round_off;
    // The temperature of a layer of some dozen particles fluctuates: nothing bounds it,
    // nor does its phase follow it.
    if(scene.particle_solid && !snapshot.heat.booked)
      entries[principle].reason = entries[phase].reason
          = "the temperature of few particles fluctuates";
    judge_principle(snapshot);
    judge_phase(snapshot);
    judge_heat(snapshot);
    judge_front(snapshot);
  }

  void SnapshotChecks::require_finite(const cases::Snapshot &snapshot) const
  {
    const auto finite = [](double value) { return std::isfinite(value); };
    if(!std::ranges::all_of(snapshot.temperature, finite))
      end_run(snapshot, "temperature", "is not finite");
    if(!std::ranges::all_of(snapshot.solid_fraction, finite))
      end_run(snapshot, "solid fraction", "is not finite");
    if(snapshot.heat.booked && !std::isfinite(snapshot.heat.defect()))
      end_run(snapshot, "heat budget", "is not finite");
  }

  /** The scene's bounds are sampled: the extremes of its initial temperature may lie at
   * sites between the samples. */
  void SnapshotChecks::include_initial(const cases::Snapshot &snapshot)
  {
    for(std::size_t i = 0; i < snapshot.temperature.size(); ++i)
    {
      const double value
          = scene.initial.temperature(site_position(snapshot, i), scene.start_time);
      if(!std::isfinite(value))
        continue;
      principle_bounds.lower = std::min(principle_bounds.lower, value);
      principle_bounds.upper = std::max(principle_bounds.upper, value);
    }
    if(scene.alloy)
      include_liquidus(snapshot);
  }

  /** Mush from which solute spreads may become colder than anything was, but not colder
   * than the liquidus of the largest concentration at hand. */
  void SnapshotChecks::include_liquidus(const cases::Snapshot &snapshot)
  {
    if(std::ranges::none_of(scene.alloy->solutes, [](const cases::Solute &solute)
                            { return solute.diffusivity > 0; }))
      return;
    const cases::PhaseDiagram diagram(scene.material, *scene.alloy);
    const auto &[first, second] = snapshot.concentration;
    for(std::size_t i = 0; i < snapshot.temperature.size(); ++i)
      principle_bounds.lower = std::min(
          principle_bounds.lower,
          diagram.liquidus(first.empty() ? 0 : first[i], second.empty() ? 0 : second[i]));
  }

  double SnapshotChecks::span() const
  {
    if(std::isfinite(principle_bounds.upper - principle_bounds.lower))
      return principle_bounds.upper - principle_bounds.lower;
    double lowest = lowest_seen, highest = highest_seen;
    if(scene.changes_phase())
    {
      lowest = std::min(lowest, scene.material.melting_temperature);
      highest = std::max(highest, scene.material.melting_temperature);
    }
    return highest - lowest;
  }

  /** What latent heat is worth (K): a state at rest may be 0 throughout. */
  double SnapshotChecks::temperature_of_melting() const
  {
    const cases::Material &material = scene.material;
    return scene.changes_phase() ? material.latent_heat
                                       / std::max(material.solid.specific_heat_capacity,
                                                  material.liquid.specific_heat_capacity)
                                 : 0;
  }

  bool SnapshotChecks::add(Kind kind, double value)
  {
    entries[kind].value = std::max(entries[kind].value.value_or(0), value);
    return value <= entries[kind].bound;
  }

  void SnapshotChecks::end_run(const cases::Snapshot &snapshot,
                               const std::string &quantity,
                               const std::string &problem) const
  {
    throw cases::NumericalError(method, snapshot.step, snapshot.time, quantity, problem);
  }

  void SnapshotChecks::judge_principle(const cases::Snapshot &snapshot)
  {
    if(!entries[principle].reason.empty())
      return;
    if(!std::isfinite(principle_bounds.lower) && !std::isfinite(principle_bounds.upper))
    {
      entries[principle].reason = "the scene bounds no temperature";
      return;
    }
    const auto [lowest, highest] = std::ranges::minmax_element(snapshot.temperature);
    const double below = principle_bounds.lower - *lowest;
    const double above = *highest - principle_bounds.upper;
    const double same
        = same_temperature
          * std::max({std::abs(*lowest), std::abs(*highest), temperature_of_melting()});
    const double beyond = std::max(below, above);
    const double value = beyond <= same ? 0 : beyond / span();
    if(add(principle, value))
      return;
    const bool cold = below > above;
    const auto worst = cold ? lowest : highest;
    end_run(
        snapshot, "temperature",
        fmt::format(
            "is {:.9g} at {}, {} value {:.9g} by {:.3g} of the span of the "
            "bounds, more than {:.3g} (maximum principle)",
            *worst,
            place_text(site_position(snapshot, static_cast<std::size_t>(
                                                   worst - snapshot.temperature.begin())),
                       snapshot.dimension),
            cold ? "below the lowest initial and wall"
                 : "above the highest initial and wall",
            cold ? principle_bounds.lower : principle_bounds.upper, value,
            entries[principle].bound));
  }

  void SnapshotChecks::judge_phase(const cases::Snapshot &snapshot)
  {
    if(!entries[phase].reason.empty())
      return;
    const double tolerance
        = entries[principle].bound * span()
          + same_temperature
                * std::max({std::abs(lowest_seen), std::abs(highest_seen),
                            temperature_of_melting()})
          + capillary_shift;
    const MetastableSites found = finder.find(snapshot, tolerance);
    if(add(phase, found.share))
      return;
    refuse_unnamed_front(snapshot, found);
    end_run(
        snapshot, "phase",
        fmt::format("is {} at {}, {:.3g} K {} its melting temperature; so is {:.3g} of "
                    "the domain, away from fronts",
                    found.solid ? "solid" : "liquid",
                    place_text(site_position(snapshot, found.site), snapshot.dimension),
                    found.beyond, found.solid ? "above" : "below", found.share));
  }

  void SnapshotChecks::refuse_unnamed_front(const cases::Snapshot &snapshot,
                                            const MetastableSites &found) const
  {
    using cases::FrontOrigin;
    const cases::Position place = site_position(snapshot, found.site);
    const double reach = spacings_to_origin * spacing;
    const bool at_source = std::ranges::any_of(
        scene.sources,
        [&](const cases::PointSource &source)
        {
          return std::hypot(source.position[0] - place[0], source.position[1] - place[1],
                            source.position[2] - place[2])
                 <= reach;
        });
    const PhasesPresent present = phases_present(snapshot);
    std::string what;
    if(at_source && !capabilities.takes(FrontOrigin::source))
      what = "fronts that set out from a source";
    else if(!at_source && distance_from_wall(scene.domain, place) <= reach
            && !capabilities.takes(FrontOrigin::wall))
      what = "fronts that set out from a wall";
    else if(capabilities.most_fronts == 1 && present.solid && present.liquid)
      what = "a second front";
    else
      return;
    throw cases::Refusal(fmt::format(
        "{} does not simulate {}; at t = {:.6g} the {} at {} is {:.3g} K {} its melting "
        "temperature",
        method, what, snapshot.time, found.solid ? "solid" : "liquid",
        place_text(place, snapshot.dimension), found.beyond,
        found.solid ? "above" : "below"));
  }

  void SnapshotChecks::judge_heat(const cases::Snapshot &snapshot)
  {
    if(!snapshot.heat.booked)
    {
      for(const Kind kind : {heat_of_sites_, balance, heat_of_walls, heat_of_sources})
        if(entries[kind].reason.empty())
          entries[kind].reason = "the method books no heat";
      return;
    }
    const SiteHeat held = heat_of_sites(scene.material, snapshot);
    const double of_domain = heat_of_domain(snapshot);
    const double off = held.difference(snapshot.heat);
    // Of a layer along walls no more than all that it can hold may be lost.
    const double all
        = std::max(held.scale(snapshot.heat), sites_are_cut() ? of_domain : 0);
    if(entries[heat_of_sites_].reason.empty()
       && !add(heat_of_sites_, off == 0 ? 0 : off / all))
      end_run(snapshot, "heat",
              fmt::format("of the sites is {:.9g} stored and {:.9g} latent, and the book "
                          "has {:.9g} and {:.9g}",
                          held.stored, held.latent, snapshot.heat.stored,
                          snapshot.heat.latent));
    const auto compare = [&](Kind kind, double booked, double expected, double gross)
    {
      if(!entries[kind].reason.empty())
        return;
      // Where nothing enters, heat is booked in relation to what there may be.
      const double scale = gross > 0 ? gross : std::max(held.magnitude, of_domain);
      const double off = std::abs(booked - expected);
      if(!add(kind, off == 0 ? 0 : off / scale))
        end_run(snapshot, entries[kind].name,
                fmt::format("is {:.9g} in the book, and {:.9g} by the scene's data",
                            booked, expected));
    };
    compare(heat_of_walls, snapshot.heat.boundary, given.through_walls(snapshot.time),
            given.gross_walls());
    compare(heat_of_sources, snapshot.heat.sources, expected_of_sources(snapshot),
            given.gross_sources());
    judge_balance(snapshot, held);
  }

  /** What sources and release bring in, by the scene's data; of a release in a steady
   * state anything between that and what the sites sample of it. */
  double SnapshotChecks::expected_of_sources(const cases::Snapshot &snapshot) const
  {
    const double exact = given.from_sources(snapshot.time);
    if(scene.problem != cases::ProblemKind::poisson || !scene.heat_release)
      return exact;
    double sampled = 0;
    for(std::size_t i = 0; i < snapshot.weights.size(); ++i)
      sampled += snapshot.weights[i]
                 * (*scene.heat_release)(site_position(snapshot, i), snapshot.time);
    // Cells that a wall holds have no weight, and their release may be booked.
    return std::clamp(snapshot.heat.sources, std::min(sampled, exact),
                      std::max(sampled, exact));
  }

  /** A tracked front cuts the volumes of sites, and so does a curved wall. */
  bool SnapshotChecks::sites_are_cut() const
  {
    return tracks_front || scene.domain.round() || scene.domain.outline;
  }

  /** What the whole domain takes up between the coldest and the warmest state seen. */
  double SnapshotChecks::heat_of_domain(const cases::Snapshot &snapshot) const
  {
    const cases::Material &material = scene.material;
    const double capacity = std::max(material.solid.volumetric_heat_capacity(),
                                     material.liquid.volumetric_heat_capacity());
    double volume = 0;
    for(const double weight : snapshot.weights)
      volume += weight;
    return volume * (capacity * span() + material.solid.density * material.latent_heat);
  }

  void SnapshotChecks::judge_balance(const cases::Snapshot &snapshot,
                                     const SiteHeat &held)
  {
    if(!entries[balance].reason.empty())
      return;
    const cases::HeatBudget &heat = snapshot.heat;
    const double imbalance = std::abs(heat.stored + heat.latent - heat.initial
                                      - heat.boundary - heat.sources);
    // What is warmer here and colder there may sum to nothing.
    largest_term = std::max(
        {largest_term, held.magnitude, std::abs(heat.stored) + std::abs(heat.latent),
         std::abs(heat.initial), std::abs(heat.boundary), std::abs(heat.sources)});
    const bool conserves = capabilities.conserves_heat;
    const double share = layers_unaccounted_for * spacing / scene.domain.side();
    entries[balance].bound = !conserves    ? share
                             : scene.alloy ? exchange_of_populations
                                           : integral_of_round_off;
    // Of the whole domain's heat a layer of one spacing, while little was exchanged.
    const double scale
        = largest_term
          + (conserves ? 0 : heat_of_domain(snapshot) / layers_unaccounted_for);
    if(!add(balance, imbalance == 0 ? 0 : imbalance / scale))
      end_run(
          snapshot, "heat balance",
          fmt::format("leaves {:.6g} unaccounted for, {:.3g} of the heat at hand, more "
                      "than {:.3g}",
                      imbalance, imbalance / scale, entries[balance].bound));
  }

  void SnapshotChecks::judge_front(const cases::Snapshot &snapshot)
  {
    if(!entries[front].reason.empty() || !tracks_front)
      return;
    if(snapshot.front[0].empty())
    {
      const PhasesPresent present = phases_present(snapshot);
      if(!add(front, present.solid && present.liquid))
        end_run(snapshot, "front", "is not reported, and there are both phases");
      return;
    }
    const StrayPoints stray = stray_points(scene.domain, snapshot, spacing);
    if(!add(front, stray.share))
      end_run(snapshot, "front",
              fmt::format("is reported at {}, where no phase changes",
                          place_text(stray.first, snapshot.dimension)));
  }

  std::vector<Check> SnapshotChecks::checks() const
  {
    std::vector<Check> result;
    for(const Entry &entry : entries)
      if(entry.value)
        result.push_back(
            {entry.name, *entry.value, entry.bound, *entry.value <= entry.bound});
    return result;
  }

  std::map<std::string, std::string> SnapshotChecks::unchecked() const
  {
    std::map<std::string, std::string> result;
    for(const Entry &entry : entries)
      if(!entry.value)
        result[entry.name] = entry.reason.empty()
                                 ? "the method reports no points of a front"
                                 : entry.reason;
    return result;
  }
} // namespace meltfront::verification
