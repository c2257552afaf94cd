#include <verification/judge/refinement.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace meltfront::verification
{
  namespace
  {
    constexpr double round_off = 1e-13;

    /** Relative: a spacing this near another is the same. */
    constexpr double equal_spacing = 1e-9;
  } // namespace

  Refinement::Refinement(const std::vector<const RunRecord *> &runs)
  {
    const RunRecord *first = nullptr;
    bool same_spacing = true, other_step = false;
    for(const RunRecord *run : runs)
    {
      if(run->status != RunStatus::finished)
        continue;
      if(!first)
        first = run;
      const cases::RunDescription &a = first->description, &b = run->description;
      same_spacing = same_spacing && b.time_step > 0
                     && std::abs(b.spacing - a.spacing) <= equal_spacing * a.spacing;
      other_step = other_step || b.time_step != a.time_step;
    }
    time = same_spacing && other_step;
  }

  bool Refinement::in_time() const
  {
    return time;
  }

  std::string Refinement::symbol() const
  {
    return time ? "dt" : "h";
  }

  double Refinement::of(const RunRecord &run) const
  {
    return time ? run.description.time_step : run.description.spacing;
  }

  int measure_dimension(const StoredCase &record)
  {
    if(record.scene.domain.shape == cases::DomainShape::axisymmetric)
      return 3;
    if(record.scene.symmetry == cases::Symmetry::none)
      return record.scene.domain.dimension;
    return record.scene.symmetry == cases::Symmetry::planar        ? 1
           : record.scene.symmetry == cases::Symmetry::cylindrical ? 2
                                                                   : 3;
  }

  double round_off_floor(const StoredCase &record, const std::string &quantity)
  {
    const bool relative = quantity.starts_with("temperature")
                          || quantity == "budget_defect"
                          || quantity.find("_relative") != std::string::npos
                          || quantity.ends_with("_bars");
    if(relative)
      return round_off;
    int power = 1;
    if(quantity.starts_with("solid_volume"))
      power = measure_dimension(record);
    return round_off * std::pow(record.scene.domain.side(), power);
  }

  double plausible_order(const RunRecord &run, const Refinement &refinement)
  {
    constexpr double any_scheme_in_space = 3, any_scheme_in_time = 5.5;
    if(refinement.in_time())
      return any_scheme_in_time;
    const auto option = [&run](const char *key)
    {
      const auto found = run.options.find(key);
      return found == run.options.end() ? 0.
                                        : std::strtod(found->second.c_str(), nullptr);
    };
    // Elements superconverge; symmetric stencils of an odd basis gain an order.
    return std::max({any_scheme_in_space, 2 * option("degree") + 0.5,
                     option("basis_order") + 1.5, option("constraint_order") + 1.5});
  }

  OrderFit fit_levels(const ErrorLevels &levels, const StoredCase &record,
                      const std::string &quantity, const RunRecord &run,
                      const Refinement &refinement)
  {
    return fit_order(levels.abscissa, levels.error, plausible_order(run, refinement),
                     round_off_floor(record, quantity));
  }
} // namespace meltfront::verification
