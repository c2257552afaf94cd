#include <verification/report/page/number_text.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    NumberText scientific(double value, int significant_digits)
    {
      const std::string written = fmt::format("{:.{}e}", value, significant_digits - 1);
      const std::size_t e = written.find('e');
      return {written.substr(0, e), std::to_string(std::stoi(written.substr(e + 1)))};
    }

    NumberText decimal(double value, int significant_digits)
    {
      const int magnitude
          = value == 0 ? 0 : static_cast<int>(std::floor(std::log10(std::abs(value))));
      return {fmt::format("{:.{}f}", value,
                          std::clamp(significant_digits - 1 - magnitude, 0, 15)),
              {}};
    }
  } // namespace

  std::string with_minus_sign(const std::string &digits)
  {
    return !digits.empty() && digits[0] == '-' ? "\u2212" + digits.substr(1) : digits;
  }

  std::string NumberText::plain() const
  {
    if(digits.empty())
      return "n/a";
    return exponent.empty() ? digits : digits + "e" + exponent;
  }

  Markup NumberText::markup() const
  {
    if(digits.empty())
      return text("\u2013");
    if(exponent.empty())
      return text(with_minus_sign(digits));
    const Markup power = text("10") + element("sup", with_minus_sign(exponent));
    return digits == "1" ? power : text(with_minus_sign(digits) + "\u00b7") + power;
  }

  std::string NumberText::tex() const
  {
    if(digits.empty())
      return "\\text{--}";
    if(digits.ends_with("\u221e"))
      return digits[0] == '-' ? "-\\infty" : "\\infty";
    return exponent.empty() ? digits : digits + "\\cdot10^{" + exponent + "}";
  }

  NumberText number_text(double value, int significant_digits, Notation notation)
  {
    if(std::isnan(value))
      return {};
    if(std::isinf(value))
      return {value > 0 ? "\u221e" : "-\u221e", {}};
    if(value == 0)
      return {"0", {}};
    if(notation == Notation::automatic)
      notation = column_notation({value});
    return notation == Notation::scientific ? scientific(value, significant_digits)
                                            : decimal(value, significant_digits);
  }

  std::string grouped(long value)
  {
    std::string digits = std::to_string(value < 0 ? -value : value);
    if(digits.size() > 4)
      for(int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3)
        digits.insert(at, "\u2009");
    return (value < 0 ? "\u2212" : "") + digits;
  }

  Notation column_notation(const std::vector<double> &values)
  {
    const bool plain = std::all_of(values.begin(), values.end(),
                                   [](double value)
                                   {
                                     const double size = std::abs(value);
                                     return !std::isfinite(value) || value == 0
                                            || (size >= 0.01 && size < 1e4);
                                   });
    return plain ? Notation::plain : Notation::scientific;
  }

  NumberText prose_number(double value, int significant_digits)
  {
    const double size = std::abs(value);
    const bool plain = size >= 1e-3 && size < 1e6;
    NumberText number = number_text(value, significant_digits,
                                    plain ? Notation::plain : Notation::scientific);
    if(number.digits.find('.') != std::string::npos)
    {
      number.digits.erase(number.digits.find_last_not_of('0') + 1);
      if(number.digits.ends_with('.'))
        number.digits.pop_back();
    }
    return number;
  }

  std::string plain_number(double value, int significant_digits)
  {
    return prose_number(value, significant_digits).plain();
  }

  Markup number_markup(double value, int significant_digits)
  {
    return prose_number(value, significant_digits).markup();
  }

  std::string duration_text(double seconds)
  {
    if(!std::isfinite(seconds))
      return "n/a";
    if(seconds < 0.0995)
      return number_text(1e3 * seconds, 2, Notation::plain).plain() + " ms";
    if(seconds < 59.5)
      return number_text(seconds, 2, Notation::plain).plain() + " s";
    const long whole = std::lround(seconds);
    if(whole < 3600)
      return fmt::format("{} min {} s", whole / 60, whole % 60);
    return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
  }
} // namespace meltfront::verification
