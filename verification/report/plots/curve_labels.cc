#include <verification/record/label.h>
#include <verification/report/plots/curve_labels.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <string>

namespace meltfront::verification
{
  namespace
  {
    using LabelOptions = std::vector<std::pair<std::string, std::string>>;

    bool contains(const LabelOptions &options, const LabelOptions::value_type &option)
    {
      return std::find(options.begin(), options.end(), option) != options.end();
    }

    std::string words(const LabelOptions::value_type &option)
    {
      const bool word
          = std::isalpha(static_cast<unsigned char>(option.second.front())) != 0
            && option.second != "true" && option.second != "false";
      return word ? option.second : option.first + "=" + option.second;
    }

    /** The options that some of the others lack or have another value for. */
    std::string differing(const LabelOptions &options,
                          const std::vector<LabelOptions> &others)
    {
      std::string result;
      for(const auto &option : options)
        if(std::any_of(others.begin(), others.end(),
                       [&option](const LabelOptions &other)
                       { return !contains(other, option); }))
          result += (result.empty() ? "" : ", ") + words(option);
      return result;
    }
  } // namespace

  void shorten_labels(Plot &plot)
  {
    std::map<std::string, std::vector<LabelOptions>> forms;
    for(const Curve &curve : plot.curves)
      if(const LabelOptions options = options_of(curve.label); !options.empty())
        forms[method_of(curve.label)].push_back(options);
    for(Curve &curve : plot.curves)
    {
      const LabelOptions options = options_of(curve.label);
      if(options.empty())
        continue;
      const std::string shorter = differing(options, forms[method_of(curve.label)]);
      if(!shorter.empty())
        curve.label = shorter;
    }
  }
} // namespace meltfront::verification
