#include <cases/case_file/prm_scan.h>
#include <cases/case_file/value_units.h>
#include <cases/effect_bounds.h>
#include <cases/scene_heat.h>
#include <verification/studies/sensitivity/scene_data.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace meltfront::verification
{
  namespace
  {
    using cases::Effect;

    constexpr const char *parts[] = {
        "Scene/Domain", "Scene/Material",          "Scene/Initial state", "Scene/Walls",
        "Scene/Source", "Scene/Volumetric source", "Scene/Inclusion"};

    constexpr const char *constants[]
        = {"dimension", "absolute zero", "Stefan-Boltzmann constant",
           "lowest temperature", "highest temperature"};

    /** Keys of text that hold an expression. */
    constexpr const char *expressions[]
        = {"temperature",  "ambient temperature",    "flux",         "power",
           "conductivity", "specific heat capacity", "power density"};

    /** Keys that only an effect reads. */
    struct OwnedKey
    {
      const char *words; ///< in the path
      Effect effect;
    };

    constexpr OwnedKey owned[]
        = {{"Scene/Material/latent heat", Effect::phase_change},
           {"Scene/Material/Liquid/conductivity", Effect::phase_conductivity},
           {"Scene/Material/Liquid/specific heat capacity", Effect::phase_heat_capacity},
           {"Scene/Material/Liquid/density", Effect::liquid_motion},
           {"Scene/Material/Gibbs-Thomson coefficient", Effect::gibbs_thomson},
           {"Scene/Source", Effect::heat_sources},
           {"Scene/Volumetric source", Effect::volumetric_source},
           {"Scene/Inclusion", Effect::inclusion}};

    template <std::size_t N>
    bool among(const char *const (&list)[N], const std::string &word)
    {
      return std::ranges::any_of(list, [&](const char *one) { return word == one; });
    }

    std::optional<double> number_of(const std::string &text)
    {
      double value = 0;
      const char *end = text.data() + text.size();
      const auto [rest, error] = std::from_chars(text.data(), end, value);
      return error == std::errc() && rest == end ? std::optional(value) : std::nullopt;
    }

    bool is_temperature(const std::string &key)
    {
      return key.ends_with("temperature");
    }

    bool is_place(const std::string &key)
    {
      return key == "position" || key == "centre" || key == "lower corner"
             || key == "upper corner" || key == "corners";
    }

    bool switched_off(const cases::EffectSet &effects, const std::string &path)
    {
      return std::ranges::any_of(
          owned, [&](const OwnedKey &key)
          { return path.starts_with(key.words) && !effects.contains(key.effect); });
    }

    void set_scale(const cases::Case &c, const std::string &key, double value,
                   Datum &datum)
    {
      const cases::TemperatureBounds given = cases::given_temperatures(c.scene);
      if(is_temperature(key) && given.upper > given.lower
         && std::isfinite(given.upper - given.lower))
      {
        datum.scale = given.upper - given.lower;
        datum.of_scale = fmt::format("of the range {:.4g} K", datum.scale);
      }
      else if(is_place(key))
      {
        datum.scale = c.scene.domain.side();
        datum.of_scale = fmt::format("of the side {:.4g} m", datum.scale);
      }
      else
      {
        datum.scale = std::abs(value);
        datum.of_scale = "of itself";
      }
    }
  } // namespace

  std::string Datum::changed(double s) const
  {
    switch(kind)
    {
    case Kind::number:
      return fmt::format("{:.17g}", *number_of(value) + s * scale);
    case Kind::component:
    {
      std::vector<std::string> numbers = cases::split_list(value, ',');
      numbers[index] = fmt::format("{:.17g}", *number_of(numbers[index]) + s * scale);
      std::string text;
      for(const std::string &number : numbers)
        text += (text.empty() ? "" : ", ") + number;
      return text;
    }
    case Kind::shifted:
      return fmt::format("({}) + ({:.17g})", value, s * scale);
    default:
      return fmt::format("({:.17g})*({})", 1 + s, value);
    }
  }

  std::vector<Datum> data_of(const cases::Case &c, std::vector<std::string> &left_out)
  {
    const cases::EffectSet effects = cases::effects_within(c.scene, c.effect_tolerance);
    std::vector<Datum> data;
    const auto add = [&](Datum datum)
    {
      if(datum.scale == 0)
        left_out.push_back(fmt::format("{} is zero: no relative change", datum.name));
      else
        data.push_back(std::move(datum));
    };
    for(const cases::PrmAssignment &assignment :
        cases::scan_prm(c.text, c.file).assignments)
    {
      const std::string path = assignment.subsection + "/" + assignment.key;
      if(std::ranges::none_of(parts, [&](const char *part)
                              { return assignment.subsection.starts_with(part); })
         || among(constants, assignment.key) || switched_off(effects, path))
        continue;
      Datum datum{path, path.substr(std::string("Scene/").size()),
                  cases::without_units(assignment.value).text};
      if(const auto number = number_of(datum.value))
      {
        set_scale(c, assignment.key, *number, datum);
        add(datum);
        continue;
      }
      const std::vector<std::string> words = cases::split_list(datum.value, ',');
      if(words.size() > 1
         && std::ranges::all_of(words, [](const std::string &word)
                                { return number_of(word).has_value(); }))
      {
        datum.kind = Datum::Kind::component;
        for(datum.index = 0; datum.index < words.size(); ++datum.index)
        {
          Datum one = datum;
          one.name += fmt::format("[{}]", datum.index + 1);
          set_scale(c, assignment.key, *number_of(words[datum.index]), one);
          add(one);
        }
        continue;
      }
      if(!among(expressions, assignment.key) || datum.value == "exact")
        continue;
      if(datum.value.find(':') != std::string::npos)
      {
        left_out.push_back(fmt::format("{} is a table", datum.name));
        continue;
      }
      set_scale(c, assignment.key, 1, datum);
      datum.kind
          = is_temperature(assignment.key) ? Datum::Kind::shifted : Datum::Kind::scaled;
      if(datum.kind == Datum::Kind::scaled)
        datum.scale = 1;
      add(datum);
    }
    return data;
  }
} // namespace meltfront::verification
