#ifndef meltfront_cases_case_file_mesh_generators_h
#define meltfront_cases_case_file_mesh_generators_h

#include <string>
#include <vector>

namespace meltfront::cases
{
  /** An argument of one of deal.II's mesh generators. */
  struct GeneratorArgument
  {
    enum class Kind
    {
      number,   ///< `least` or more
      positive, ///< a number greater than 0
      count,    ///< whole, `least` or more: there are cells in proportion to it
      each_way, ///< the same of cells along every direction
      whole,    ///< whole, `least` or more: cells do not depend on it
      flag,     ///< true or false
      point,
      cell_corners,        ///< points: those of a quadrilateral or a hexahedron
      simplex_corners,     ///< points: those of a triangle or a tetrahedron
      counts_by_direction, ///< whole, `least` or more, one for each
      counts_by_side       ///< whole, `least` or more, two for each direction
    };

    const char *name;
    Kind kind;
    double least = 0;
    const char *less_than = nullptr; ///< the argument that exceeds it, if one has to
  };

  /** One of deal.II's mesh generators. deal.II itself, built for speed, believes what it
   * is told: what it must not be told is known here. */
  struct MeshGenerator
  {
    const char *name;
    std::vector<int> dimensions; ///< that it makes meshes of
    std::vector<GeneratorArgument> arguments;
  };

  /** Those that cases may name. */
  const std::vector<MeshGenerator> &mesh_generators();

  /** The arguments as messages show them: `centre (x, y) : radius`. */
  std::string arguments_in_words(const MeshGenerator &generator, int dimension);

  /** @throws InputError, one clause without place, unless the text holds the generator's
   * arguments, separated by colons */
  void check_arguments(const MeshGenerator &generator, int dimension,
                       const std::string &text);
} // namespace meltfront::cases

#endif
