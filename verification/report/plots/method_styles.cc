#include <verification/report/plots/method_styles.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::verification
{
  namespace
  {
    constexpr int n_markers = 6;
    constexpr const char *as_published = "-2005";

    bool published_form(const std::string &label)
    {
      const std::string method = label.substr(0, label.find('['));
      return method.ends_with(as_published);
    }

    Markup marker_shape(const LineStyle &style, const std::string &colour)
    {
      const Attributes paint{{"fill", style.open ? "var(--page)" : colour},
                             {"stroke", colour},
                             {"stroke-width", "1.5"}};
      const auto shape = [&paint](const std::string &name, Attributes attributes)
      {
        attributes.insert(attributes.end(), paint.begin(), paint.end());
        return void_element(name, attributes);
      };
      switch(style.marker)
      {
      case Marker::square:
        return shape("rect",
                     {{"x", "12.5"}, {"y", "2.5"}, {"width", "7"}, {"height", "7"}});
      case Marker::triangle:
        return shape("path", {{"d", "M16,1 L20.5,9.5 L11.5,9.5 z"}});
      case Marker::triangle_down:
        return shape("path", {{"d", "M16,11 L20.5,2.5 L11.5,2.5 z"}});
      case Marker::diamond:
        return shape("path", {{"d", "M16,1 L21,6 L16,11 L11,6 z"}});
      case Marker::pentagon:
        return shape("path", {{"d", "M16,1 L20.8,4.5 L18.9,10 L13.1,10 L11.2,4.5 z"}});
      default:
        return shape("circle", {{"cx", "16"}, {"cy", "6"}, {"r", "4"}});
      }
    }
  } // namespace

  namespace
  {
    /** The method, and the options of a variant as an element of their own. */
    Markup label_text(const std::string &label)
    {
      const std::size_t bracket = label.find('[');
      if(bracket == std::string::npos)
        return text(label);
      std::string options = label.substr(bracket);
      // A zero-width space lets a line break there.
      for(std::size_t comma = options.find(','); comma != std::string::npos;
          comma = options.find(',', comma + 1))
        options.insert(comma + 1, "\u200b");
      return element("span",
                     text(label.substr(0, bracket))
                         + element("span", {{"class", "options"}}, text(options)));
    }
  } // namespace

  const std::array<Colour, 7> &palette()
  {
    static const std::array<Colour, 7> colours{{{"#0072b2", "#58b4ec"},
                                                {"#d55e00", "#ff9248"},
                                                {"#009e73", "#35cfa1"},
                                                {"#b5568d", "#e79ac8"},
                                                {"#b88400", "#f2bd3a"},
                                                {"#5b5fc7", "#a5a9ff"},
                                                {"#6b6257", "#c2b8ab"}}};
    return colours;
  }

  std::string base_method(const std::string &label)
  {
    std::string method = label.substr(0, label.find('['));
    if(method.ends_with(as_published))
      method.resize(method.size() - std::string_view(as_published).size());
    return method;
  }

  MethodStyles::MethodStyles(const std::vector<std::string> &labels)
  {
    std::vector<std::string> bases;
    std::map<std::string, int> variants;
    for(const std::string &label : labels)
    {
      if(styles.count(label))
        continue;
      const std::string base = base_method(label);
      auto found = std::find(bases.begin(), bases.end(), base);
      if(found == bases.end())
        found = bases.insert(bases.end(), base);
      const int index = static_cast<int>(found - bases.begin());
      LineStyle style;
      style.colour = index % static_cast<int>(palette().size());
      style.marker = static_cast<Marker>(index % n_markers);
      style.open = published_form(label);
      style.dash = style.open ? 1 : 0;
      if(label.find('[') != std::string::npos)
      {
        const int variant = ++variants[base];
        style.marker = static_cast<Marker>((index + variant) % n_markers);
        style.dash = style.open ? 3 : 2;
      }
      styles.emplace(label, style);
    }
  }

  LineStyle MethodStyles::style(const std::string &label) const
  {
    const auto found = styles.find(label);
    return found == styles.end() ? LineStyle() : found->second;
  }

  Markup MethodStyles::key(const std::string &label) const
  {
    if(!styles.count(label))
      return text(label);
    const LineStyle line = style(label);
    const std::string colour = fmt::format("var(--series-{})", line.colour);
    constexpr const char *dashes[] = {"none", "6 4", "2 3", "7 3 2 3"};
    const Markup stroke = void_element("path", {{"d", "M0,6 L32,6"},
                                                {"stroke", colour},
                                                {"stroke-width", "2"},
                                                {"stroke-dasharray", dashes[line.dash]},
                                                {"fill", "none"}});
    return element("span", {{"class", "key"}},
                   element("svg",
                           {{"viewBox", "0 0 32 12"},
                            {"width", "32"},
                            {"height", "12"},
                            {"aria-hidden", "true"}},
                           stroke + marker_shape(line, colour))
                       + label_text(label));
  }

  Markup MethodStyles::legend(const std::vector<std::string> &labels) const
  {
    Markup keys;
    for(const std::string &label : labels)
      keys += key(label) + Markup(" ");
    if(labels.empty())
      return {};
    const Markup all = element("p", {{"class", "legend"}}, keys);
    constexpr std::size_t most_unfolded = 24;
    return labels.size() <= most_unfolded
               ? all
               : element("details", element("summary", fmt::format("Keys of {} labels",
                                                                   labels.size()))
                                        + all);
  }

  int point_type(Marker marker, bool open)
  {
    constexpr int filled[] = {7, 5, 9, 11, 13, 15};
    // gnuplot numbers the open form of a shape just before the filled one.
    return filled[static_cast<int>(marker)] - (open ? 1 : 0);
  }
} // namespace meltfront::verification
