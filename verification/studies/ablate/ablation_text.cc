#include <verification/studies/ablate/ablate.h>

#include <fmt/format.h>

namespace meltfront::verification
{
  namespace
  {
    using nlohmann::json;

    std::string figure(const json &value, const char *format)
    {
      return value.is_number() ? fmt::format(fmt::runtime(format), value.get<double>())
                               : "-";
    }

    std::string change_of(const json &change)
    {
      return fmt::format(
          "{:>10} +-{:>8} {:>8} {:>9}", figure(change.at("change"), "{:.3g}"),
          figure(change.at("bar"), "{:.1g}"), figure(change.at("in_bars"), "{:.3g}"),
          figure(change.at("bound"), "{:.2g}"));
    }
  } // namespace

  std::string ablation_text(const json &ablation)
  {
    constexpr const char *names[]
        = {"front", "front_over_time", "solid_volume", "temperature"};
    std::string text = fmt::format(
        "{} by {} at n = {}, {:.3g} s a run\n", ablation.at("case").get<std::string>(),
        ablation.at("method").get<std::string>(), ablation.at("n").back().get<int>(),
        ablation.at("seconds").get<double>());
    for(const char *name : names)
    {
      const json &full = ablation.at("full").at(name);
      if(full.at("bar").is_null())
        continue;
      text += fmt::format("  {:<16} {:>10}  bar {}{}\n", name,
                          figure(full.at("value"), "{:.6g}"),
                          figure(full.at("bar"), "{:.2g}"),
                          full.at("converging").get<bool>() ? "" : " (not converging)");
    }
    text += fmt::format("\n{:<24} {:<16} {:>10}   {:>8} {:>8} {:>9} {:>9} {:>9}\n",
                        "without", "quantity", "change", "+-", "in bars", "bound",
                        "saves s", "bytes");
    for(const json &row : ablation.at("effects"))
    {
      const std::string effect = row.at("effect");
      if(row.contains("refused"))
      {
        text += fmt::format("{:<24} refused: {}\n", effect,
                            row.at("refused").get<std::string>());
        continue;
      }
      bool first = true;
      for(const char *name : names)
      {
        const json &change = row.at("changes").at(name);
        if(!change.at("change").is_number())
          continue;
        text += fmt::format("{:<24} {:<16} {}", first ? effect : "", name,
                            change_of(change));
        if(first)
          text += fmt::format(" {:>9.2g} {:>9.0f}", row.at("seconds_saved").get<double>(),
                              row.at("bytes_saved").get<double>());
        text += "\n";
        first = false;
      }
      text += fmt::format("{:<24} known before: {}\n", "",
                          row.at("bound").at("words").get<std::string>());
    }
    text += "Front and volume in m, m^2 or m^3, temperature in K (root mean square over "
            "places at the end); bar: of the full scene's value.\n";
    return text;
  }
} // namespace meltfront::verification
