#include <cases/case_file/mesh_generators.h>
#include <cases/case_file/prm_scan.h>
#include <cases/error.h>
#include <cases/numbers.h>
#include <cases/options.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace meltfront::cases
{
  namespace
  {
    using Kind = GeneratorArgument::Kind;

    /** Most cells that a generator's counts may ask for: more would be written before
     * they can be counted. */
    constexpr double most_asked_for = 1e5;

    std::vector<std::string> axis_names(int dimension)
    {
      return dimension == 2 ? std::vector<std::string>{"x", "y"}
                            : std::vector<std::string>{"x", "y", "z"};
    }

    std::size_t values_in(const GeneratorArgument &argument, int dimension)
    {
      switch(argument.kind)
      {
      case Kind::cell_corners:
        return std::size_t(1) << dimension;
      case Kind::simplex_corners:
        return std::size_t(dimension) + 1;
      case Kind::counts_by_direction:
        return std::size_t(dimension);
      case Kind::counts_by_side:
        return 2 * std::size_t(dimension);
      default:
        return 1;
      }
    }

    /** What an argument needs, in words. */
    std::string needs_of(const GeneratorArgument &argument, int dimension)
    {
      const std::string point = fmt::format("{}", fmt::join(axis_names(dimension), ", "));
      const std::size_t values = values_in(argument, dimension);
      switch(argument.kind)
      {
      case Kind::number:
        return std::isinf(argument.least)
                   ? "a number"
                   : fmt::format("a number of {} or more", argument.least);
      case Kind::positive:
        return "a number greater than 0";
      case Kind::count:
      case Kind::each_way:
      case Kind::whole:
        return fmt::format("a whole number of {} or more", argument.least);
      case Kind::flag:
        return "true or false";
      case Kind::point:
        return fmt::format("a point {}", point);
      case Kind::cell_corners:
      case Kind::simplex_corners:
        return fmt::format("{} points {}; {}; ...", values, point, point);
      default:
        return fmt::format("{} whole numbers of {} or more, separated by commas", values,
                           argument.least);
      }
    }

    double read_value(const std::string &text)
    {
      double value = 0;
      const char *end = text.data() + text.size();
      const auto [stop, error] = std::from_chars(text.data(), end, value);
      return text.empty() || error != std::errc() || stop != end || !std::isfinite(value)
                 ? nan
                 : value;
    }

    bool is_whole(const std::string &text, double least)
    {
      constexpr double largest = 1e9; // well within what deal.II reads as unsigned int
      const double value = read_value(text);
      return value >= least && value <= largest
             && text.find_first_not_of("0123456789") == std::string::npos;
    }

    bool is_point(const std::string &text, int dimension)
    {
      const std::vector<std::string> parts = split_list(text, ',');
      for(const std::string &part : parts)
        if(std::isnan(read_value(part)))
          return false;
      return parts.size() == std::size_t(dimension);
    }

    template <typename Holds>
    bool all_hold(const std::vector<std::string> &parts, std::size_t number,
                  const Holds &holds)
    {
      for(const std::string &part : parts)
        if(!holds(part))
          return false;
      return parts.size() == number;
    }

    bool holds(const GeneratorArgument &argument, int dimension, const std::string &text)
    {
      const std::size_t values = values_in(argument, dimension);
      switch(argument.kind)
      {
      case Kind::number:
        return read_value(text) >= argument.least;
      case Kind::positive:
        return read_value(text) > 0;
      case Kind::count:
      case Kind::each_way:
      case Kind::whole:
        return is_whole(text, argument.least);
      case Kind::flag:
        return text == "true" || text == "false";
      case Kind::point:
        return is_point(text, dimension);
      case Kind::cell_corners:
      case Kind::simplex_corners:
        return all_hold(split_list(text, ';'), values,
                        [&](const std::string &part)
                        { return is_point(part, dimension); });
      default:
        return all_hold(split_list(text, ','), values,
                        [&](const std::string &part)
                        { return is_whole(part, argument.least); });
      }
    }

    /** By which factor an argument multiplies the number of cells. */
    double times_cells(const GeneratorArgument &argument, int dimension,
                       const std::string &text)
    {
      double factor = 1;
      if(argument.kind == Kind::count)
        factor = std::max(1., read_value(text));
      else if(argument.kind == Kind::each_way)
        factor = std::pow(std::max(1., read_value(text)), dimension);
      else if(argument.kind == Kind::counts_by_direction
              || argument.kind == Kind::counts_by_side)
        for(const std::string &part : split_list(text, ','))
          factor *= std::max(1., read_value(part));
      return factor;
    }
  } // namespace

  const std::vector<MeshGenerator> &mesh_generators()
  {
    const std::vector<int> plane_and_space{2, 3}, space{3};
    const GeneratorArgument colorize{"colorize", Kind::flag},
        centre{"centre", Kind::point}, radius{"radius", Kind::positive},
        inner_radius{"inner radius", Kind::positive, 0, "outer radius"},
        outer_radius{"outer radius", Kind::positive},
        left{"left", Kind::number, -infinity, "right"},
        right{"right", Kind::number, -infinity}, lower{"lower corner", Kind::point},
        upper{"upper corner", Kind::point}, half_length{"half length", Kind::positive},
        tube{"radius of the tube", Kind::positive, 0, "radius of the ring"},
        cells_around{"cells around, 0 for deal.II's choice", Kind::count};
    static const std::vector<MeshGenerator> generators{
        {"hyper_cube", plane_and_space, {left, right, colorize}},
        {"subdivided_hyper_cube",
         plane_and_space,
         {{"cells along a side", Kind::each_way, 1}, left, right, colorize}},
        {"hyper_rectangle", plane_and_space, {lower, upper, colorize}},
        {"subdivided_hyper_rectangle",
         plane_and_space,
         {{"cells", Kind::counts_by_direction, 1}, lower, upper, colorize}},
        {"general_cell", plane_and_space, {{"corners", Kind::cell_corners}, colorize}},
        {"simplex", plane_and_space, {{"corners", Kind::simplex_corners}}},
        {"hyper_L", plane_and_space, {left, right, colorize}},
        {"hyper_cross",
         plane_and_space,
         {{"cells of the arms", Kind::counts_by_side}, colorize}},
        {"cheese",
         {2},
         {{"holes", Kind::counts_by_direction, 1}}}, // in space it has none
        {"enclosed_hyper_cube",
         plane_and_space,
         {left, right, {"thickness", Kind::positive}, colorize}},
        {"plate_with_a_hole",
         plane_and_space,
         {inner_radius,
          outer_radius,
          {"pad below", Kind::number},
          {"pad above", Kind::number},
          {"pad on the left", Kind::number},
          {"pad on the right", Kind::number},
          centre,
          {"number of the polar manifold", Kind::whole},
          {"number of the other manifold", Kind::whole},
          {"length in z", Kind::positive},
          {"slices in z", Kind::count, 2},
          colorize}},
        {"channel_with_cylinder",
         plane_and_space,
         {{"width of the shells", Kind::positive},
          {"shells", Kind::count},
          {"skewness", Kind::number},
          colorize}},
        {"hyper_cube_with_cylindrical_hole",
         plane_and_space,
         {inner_radius,
          outer_radius,
          {"length in z", Kind::positive},
          {"cells in z", Kind::count, 1},
          colorize}},
        {"hyper_ball", plane_and_space, {centre, radius, {"spheres inside", Kind::flag}}},
        {"quarter_hyper_ball", plane_and_space, {centre, radius}},
        {"half_hyper_ball", plane_and_space, {centre, radius}},
        {"hyper_shell",
         plane_and_space,
         {centre, inner_radius, outer_radius, cells_around, colorize}},
        {"half_hyper_shell",
         plane_and_space,
         {centre, inner_radius, outer_radius, cells_around, colorize}},
        {"quarter_hyper_shell",
         plane_and_space,
         {centre, inner_radius, outer_radius, cells_around, colorize}},
        {"concentric_hyper_shells",
         plane_and_space,
         {centre,
          inner_radius,
          outer_radius,
          {"shells", Kind::count, 1},
          {"skewness", Kind::number},
          cells_around,
          colorize}},
        {"cylinder", space, {radius, half_length}},
        {"truncated_cone",
         space,
         {{"radius at the left", Kind::positive},
          {"radius at the right", Kind::positive},
          half_length}},
        {"cylinder_shell",
         space,
         {{"length", Kind::positive},
          inner_radius,
          outer_radius,
          cells_around,
          {"cells along the axis, 0 for deal.II's choice", Kind::count}}},
        {"torus",
         space,
         {{"radius of the ring", Kind::positive},
          tube,
          {"cells around the ring", Kind::count, 3},
          {"angle", Kind::positive}}},
        {"moebius",
         space,
         {{"cells around the ring", Kind::count, 5},
          {"quarter turns", Kind::whole},
          {"radius of the ring", Kind::positive},
          tube}}};
    return generators;
  }

  std::string arguments_in_words(const MeshGenerator &generator, int dimension)
  {
    std::vector<std::string> words;
    for(const GeneratorArgument &argument : generator.arguments)
      words.push_back(
          fmt::format("{} ({})", argument.name, needs_of(argument, dimension)));
    return fmt::format("{}", fmt::join(words, " : "));
  }

  void check_arguments(const MeshGenerator &generator, int dimension,
                       const std::string &text)
  {
    const std::vector<std::string> given = split_list(text, ':');
    if(given.size() != generator.arguments.size())
      throw InputError(fmt::format("must hold {} values separated by colons, not {}: {}",
                                   generator.arguments.size(), given.size(),
                                   arguments_in_words(generator, dimension)));
    double cells = 1;
    for(std::size_t i = 0; i < given.size(); ++i)
    {
      const GeneratorArgument &argument = generator.arguments[i];
      if(!holds(argument, dimension, given[i]))
        throw InputError(fmt::format("holds '{}' as the {} of a {}, which must be {}",
                                     quotable(given[i]), argument.name, generator.name,
                                     needs_of(argument, dimension)));
      cells *= times_cells(argument, dimension, given[i]);
    }
    for(std::size_t i = 0; i < given.size(); ++i)
      for(std::size_t k = 0; k < given.size(); ++k)
        if(const char *larger = generator.arguments[i].less_than;
           larger && generator.arguments[k].name == std::string(larger)
           && !(read_value(given[i]) < read_value(given[k])))
          throw InputError(fmt::format("holds {} as the {} of a {} and {} as the {}, "
                                       "which must be larger",
                                       given[i], generator.arguments[i].name,
                                       generator.name, given[k], larger));
    if(cells > most_asked_for)
      throw InputError(fmt::format("asks for {:.2g} cells and more; there may be {:g}",
                                   cells, most_asked_for));
  }
} // namespace meltfront::cases
