#include <verification/measure/checks/snapshot_checks.h>
#include <verification/measure/formulas/site_coordinates.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    /** Relative to the heat at hand: the published exchange between crystals and liquid
     * of an alloy's site loses some thousandths of it. */
    constexpr double exchange_of_populations = 1e-2;

    /** Spacings: at two walls and on both sides of a front. */
    constexpr double layers_unaccounted_for = 4;
  } // namespace

  void SnapshotChecks::judge_heat(const cases::Snapshot &snapshot)
  {
    if(!snapshot.heat.conservative)
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
    if(scene.problem != cases::ProblemKind::poisson || !scene.volumetric_source)
      return exact;
    double sampled = 0;
    for(std::size_t i = 0; i < snapshot.weights.size(); ++i)
      sampled += snapshot.weights[i]
                 * (*scene.volumetric_source)(site_position(snapshot, i), snapshot.time);
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
    return heat_between(snapshot, span());
  }

  double SnapshotChecks::heat_between(const cases::Snapshot &snapshot, double range) const
  {
    const cases::Material &material = scene.material;
    const double capacity = std::max(material.solid.volumetric_heat_capacity(),
                                     material.liquid.volumetric_heat_capacity());
    double volume = 0;
    for(const double weight : snapshot.weights)
      volume += weight;
    return volume * (capacity * range + material.solid.density * material.latent_heat);
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
    // While little was exchanged, a layer of one spacing of the whole domain's heat as it
    // is now: what a pulse held for a moment excuses nothing later.
    const auto [coldest, warmest] = std::ranges::minmax(snapshot.temperature);
    const double scale
        = conserves ? largest_term
                    : std::max(largest_term, heat_between(snapshot, warmest - coldest)
                                                 / layers_unaccounted_for);
    if(!add(balance, imbalance == 0 ? 0 : imbalance / scale))
      end_run(
          snapshot, "heat balance",
          fmt::format("leaves {:.6g} unaccounted for, {:.3g} of the heat at hand, more "
                      "than {:.3g}",
                      imbalance, imbalance / scale, entries[balance].bound));
  }
} // namespace meltfront::verification
