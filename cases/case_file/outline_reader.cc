#include <cases/case_file/expression.h>
#include <cases/case_file/key_builders.h>
#include <cases/case_file/outline_reader.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace meltfront::cases
{
  namespace
  {

    double read_coordinate(const std::string &text, int corner)
    {
      double value = 0;
      const char *end = text.data() + text.size();
      const auto [stop, error] = std::from_chars(text.data(), end, value);
      if(text.empty() || error != std::errc() || stop != end || !std::isfinite(value))
        throw InputError(fmt::format("holds '{}' in corner {}, which is no number",
                                     quotable(text), corner));
      return value;
    }

    std::vector<Outline::Point> read_corners(const std::string &text)
    {
      std::vector<Outline::Point> corners;
      for(const std::string &corner : split_list(text, ';'))
      {
        const int number = static_cast<int>(corners.size()) + 1;
        const std::vector<std::string> parts = split_list(corner, ',');
        if(parts.size() != 2)
          throw InputError(fmt::format("needs two coordinates in corner {}, as in 'x, y; "
                                       "x, y; x, y', not '{}'",
                                       number, quotable(corner)));
        corners.push_back(
            {read_coordinate(parts[0], number), read_coordinate(parts[1], number)});
      }
      return corners;
    }

    Outline::Point read_centre(const PrmFile &prm)
    {
      if(!prm.given(domain_keys, "centre"))
        return {};
      const std::vector<double> values = prm.get_numbers(domain_keys, "centre");
      if(values.size() != 2)
        throw prm.error(domain_keys, "centre",
                        fmt::format("needs 2 coordinates, not {}", values.size()));
      return {values[0], values[1]};
    }
  } // namespace

  void read_outline(const PrmFile &prm, Domain &domain)
  {
    const bool polar = prm.given(domain_keys, "polar radius");
    if(polar)
      prm.forbid(domain_keys, "corners", "the outline is given by its polar radius");
    else
      prm.require(domain_keys, "corners",
                  "an outline needs it, or the key 'polar radius'");
    const std::string key = polar ? "polar radius" : "corners";
    const Outline::Point centre = read_centre(prm);
    const std::string text = prm.get_text(domain_keys, key);
    domain.shape = DomainShape::outline;
    try
    {
      domain.outline
          = polar ? std::make_shared<const Outline>(parse_function(text, "phi"), centre)
                  : std::make_shared<const Outline>(read_corners(text), centre);
    }
    catch(const InputError &error)
    {
      throw prm.error(domain_keys, key, error.what());
    }
    const Outline &outline = *domain.outline;
    for(int d = 0; d < 2; ++d)
    {
      domain.lower[d] = outline.lower()[d];
      domain.upper[d] = outline.upper()[d];
    }
    domain.reference_length = prm.given(domain_keys, "reference length")
                                  ? prm.get_number(domain_keys, "reference length")
                                  : std::max(domain.upper[0] - domain.lower[0],
                                             domain.upper[1] - domain.lower[1]);
  }

  void forbid_outline_keys(const PrmFile &prm, const std::string &shape)
  {
    for(const char *key : {"corners", "polar radius", "centre", "reference length"})
      prm.forbid(domain_keys, key, fmt::format("the shape is a {}", shape));
  }
} // namespace meltfront::cases
