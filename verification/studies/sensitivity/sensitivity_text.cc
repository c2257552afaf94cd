#include <verification/studies/sensitivity/sensitivity.h>

#include <fmt/format.h>

namespace meltfront::verification
{
  namespace
  {
    using nlohmann::json;

    std::string figure(const json &value, const char *format, double factor = 1)
    {
      return value.is_number()
                 ? fmt::format(fmt::runtime(format), factor * value.get<double>())
                 : "-";
    }

    /** Per one per cent. */
    std::string derivative_text(const json &derivative)
    {
      return fmt::format("{:>10} +-{:>8}",
                         figure(derivative.at("derivative"), "{:+.3g}", 0.01),
                         figure(derivative.at("error"), "{:.1g}", 0.01));
    }
  } // namespace

  std::string sensitivity_text(const json &sensitivity)
  {
    const json &front = sensitivity.at("front"), &volume = sensitivity.at("solid_volume");
    std::string text = fmt::format(
        "{} by {} at n = {}: front {} m, numerical error {} m; solid volume {}, {}\n\n",
        sensitivity.at("case").get<std::string>(),
        sensitivity.at("method").get<std::string>(), sensitivity.at("n").get<int>(),
        figure(front.at("value"), "{:.6g}"), figure(front.at("bar"), "{:.2g}"),
        figure(volume.at("value"), "{:.6g}"), figure(volume.at("bar"), "{:.2g}"));
    text += fmt::format("{:<42} {:<14} {:>20} {:>20} {:>20}  {}\n",
                        "change for 1 % of this datum", "value", "front (m)",
                        "solid volume", "temperature (K)", "numerical error equals");
    const json *nearest = nullptr;
    for(const json &row : sensitivity.at("data"))
    {
      const std::string name = row.at("name");
      if(row.contains("refused"))
      {
        text += fmt::format("{:<42} refused: {}\n", name,
                            row.at("refused").get<std::string>());
        continue;
      }
      if(!nearest && row.at("worth_of_bar").is_number())
        nearest = &row;
      text += fmt::format("{:<42} {:<14} {} {} {}  {} % {}\n", name,
                          row.at("value").get<std::string>().substr(0, 14),
                          derivative_text(row.at("front")),
                          derivative_text(row.at("solid_volume")),
                          derivative_text(row.at("temperature")),
                          figure(row.at("worth_of_bar"), "{:.2g}", 100),
                          row.at("of_scale").get<std::string>());
    }
    for(const json &sentence : sensitivity.at("left_out"))
      text += fmt::format("left out: {}\n", sentence.get<std::string>());
    if(nearest)
      text += fmt::format("The numerical error of the front equals {} % of {} ({}).\n",
                          figure(nearest->at("worth_of_bar"), "{:.2g}", 100),
                          nearest->at("name").get<std::string>(),
                          nearest->at("of_scale").get<std::string>());
    return text;
  }
} // namespace meltfront::verification
