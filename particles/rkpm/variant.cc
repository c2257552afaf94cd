#include <cases/error.h>
#include <particles/rkpm/variant.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace meltfront::particles::rkpm
{
  const std::vector<std::string> &variant_names()
  {
    static const std::vector<std::string> names{"point_collocation", "fixed_point",
                                                "moving", "multiple_fixed",
                                                "derivative_free"};
    return names;
  }

  const std::string &variant_name(Variant variant)
  {
    return variant_names()[static_cast<std::size_t>(variant)];
  }

  Variant variant(const std::string &name)
  {
    const auto &names = variant_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if(found == names.end())
      throw cases::InputError(
          fmt::format("there is no variant '{}' of the reproducing kernel; there are {}",
                      name, fmt::join(names, ", ")));
    return static_cast<Variant>(found - names.begin());
  }

  bool differentiates_kernel(Variant variant)
  {
    return variant == Variant::point_collocation || variant == Variant::moving
           || variant == Variant::multiple_fixed;
  }
} // namespace meltfront::particles::rkpm
