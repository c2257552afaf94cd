#include <particles/sph/enclosed_liquid.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace meltfront::particles
{
  namespace
  {
    constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();
  }

  EnclosedLiquid::EnclosedLiquid(const ParticleOperator &rows,
                                 std::vector<std::uint32_t> openings)
    : rows(rows)
    , openings(std::move(openings))
  {
  }

  /** From those found on, to neighbours that let pass: they inherit the heir. */
  template <typename Passes>
  void EnclosedLiquid::spread(const Passes &passes)
  {
    for(std::size_t i = 0; i < found.size(); ++i)
    {
      const std::uint32_t from = found[i];
      rows.visit_row(from,
                     [&](std::uint32_t b, double)
                     {
                       if(heir[b] != nobody || !passes(b))
                         return;
                       heir[b] = heir[from];
                       found.push_back(b);
                     });
    }
  }

  /** It is wide if a particle of it borders on none but its own. */
  EnclosedLiquid::Pocket EnclosedLiquid::pocket_about(std::uint32_t particle,
                                                      std::span<const double> liquid,
                                                      std::span<const double> due)
  {
    found = {particle};
    heir[particle] = particle;
    spread([&](std::uint32_t b) { return liquid[b] > 0; });
    Pocket pocket{found};
    for(const std::uint32_t a : found)
    {
      bool inside = true;
      rows.visit_row(a,
                     [&](std::uint32_t b, double) { inside = inside && liquid[b] > 0; });
      pocket.wide = pocket.wide || inside;
      pocket.most_due = std::max(pocket.most_due, std::abs(due[a]));
    }
    return pocket;
  }

  EnclosedLiquid::Outcome EnclosedLiquid::settle(std::span<double> liquid,
                                                 std::span<double> due)
  {
    heir.assign(rows.rows(), nobody);
    found.clear();
    for(const std::uint32_t a : openings)
      if(liquid[a] > 0)
      {
        heir[a] = a;
        found.push_back(a);
      }
    spread([&](std::uint32_t b) { return liquid[b] > 0; });
    const std::vector<std::uint32_t> open = found;
    std::vector<std::uint32_t> narrow;
    Outcome outcome;
    for(std::uint32_t a = 0; a < rows.rows(); ++a)
      if(liquid[a] > 0 && heir[a] == nobody)
      {
        const Pocket pocket = pocket_about(a, liquid, due);
        if(pocket.wide)
          outcome.stuck = std::max(outcome.stuck, pocket.most_due);
        else
          narrow.insert(narrow.end(), pocket.particles.begin(), pocket.particles.end());
      }
    std::fill(liquid.begin(), liquid.end(), 0.);
    for(const std::uint32_t a : open)
      liquid[a] = 1;
    if(narrow.empty())
      return outcome;
    heir.assign(rows.rows(), nobody);
    found = open;
    for(const std::uint32_t a : open)
      heir[a] = a;
    spread([](std::uint32_t) { return true; });
    for(const std::uint32_t a : narrow)
      (heir[a] == nobody ? outcome.straight_out : due[heir[a]])
          += std::exchange(due[a], 0.);
    return outcome;
  }
} // namespace meltfront::particles
