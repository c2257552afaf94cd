#include <cases/case_file/domain_reader.h>
#include <cases/case_file/key_builders.h>
#include <cases/case_file/mesh_reader.h>
#include <cases/case_file/outline_reader.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::cases
{
  namespace
  {

    /** Keys that belong to one shape only. */
    void check_shape_keys(const PrmFile &prm, const std::string &shape)
    {
      const auto belongs = [&](const std::string &key, const std::string &owner)
      {
        if(shape == owner)
          prm.require(domain_keys, key, fmt::format("a {} needs it", shape));
        else
          prm.forbid(domain_keys, key, fmt::format("the shape is a {}", shape));
      };
      belongs("length", "slab");
      if(shape != "slab")
        prm.forbid(domain_keys, "left end", fmt::format("the shape is a {}", shape));
      const std::string rectangle = shape == "axisymmetric" ? shape : "box";
      belongs("lower corner", rectangle);
      belongs("upper corner", rectangle);
      belongs("radius", shape == "shell" ? "shell" : "ball");
      belongs("inner radius", "shell");
      if(shape != "outline")
        forbid_outline_keys(prm, shape);
      if(shape != "mesh")
        forbid_mesh_keys(prm, shape);
    }

    void read_rectangle(const PrmFile &prm, const std::string &shape, Domain &domain)
    {
      domain.shape = shape == "box" ? DomainShape::box : DomainShape::axisymmetric;
      domain.lower = read_position(prm, domain_keys, "lower corner", domain.dimension);
      domain.upper = read_position(prm, domain_keys, "upper corner", domain.dimension);
      for(int d = 0; d < domain.dimension; ++d)
        if(!(domain.lower[d] < domain.upper[d]))
          throw prm.error(domain_keys, "upper corner",
                          "must exceed 'lower corner' in every coordinate");
      if(domain.shape == DomainShape::axisymmetric && domain.lower[0] < 0)
        throw prm.error(domain_keys, "lower corner",
                        "cannot lie beyond the axis of an axisymmetric domain: x is the "
                        "distance from it");
    }

    void read_round_shape(const PrmFile &prm, const std::string &shape, Domain &domain)
    {
      domain.shape = shape == "ball" ? DomainShape::ball : DomainShape::shell;
      domain.radius = prm.get_number(domain_keys, "radius");
      if(domain.shape == DomainShape::ball)
        return;
      domain.inner_radius = prm.get_number(domain_keys, "inner radius");
      if(!(domain.inner_radius < domain.radius))
        throw prm.error(domain_keys, "inner radius",
                        fmt::format("({}) must be less than 'radius' ({})",
                                    domain.inner_radius, domain.radius));
    }
  } // namespace

  Symmetry read_symmetry(const PrmFile &prm)
  {
    const std::string word = prm.get_text("Scene", "symmetry");
    if(word == "planar")
      return Symmetry::planar;
    if(word == "cylindrical")
      return Symmetry::cylindrical;
    return word == "spherical" ? Symmetry::spherical : Symmetry::none;
  }

  Position read_position(const PrmFile &prm, const std::string &subsection,
                         const std::string &key, int dimension)
  {
    const std::vector<double> values = prm.get_numbers(subsection, key);
    if(values.size() != static_cast<std::size_t>(dimension))
      throw prm.error(subsection, key,
                      fmt::format("needs {} coordinate{}, not {}", dimension,
                                  dimension == 1 ? "" : "s", values.size()));
    Position position{};
    std::copy(values.begin(), values.end(), position.begin());
    return position;
  }

  Domain read_domain(const PrmFile &prm)
  {
    const std::string shape = prm.get_text(domain_keys, "shape");
    check_shape_keys(prm, shape);
    Domain domain;
    domain.dimension = static_cast<int>(prm.get_integer(domain_keys, "dimension"));
    if(shape != "slab")
      prm.require(domain_keys, "dimension",
                  shape == "outline"        ? "an outline needs 2"
                  : shape == "axisymmetric" ? "an axisymmetric section has 2"
                                            : fmt::format("a {} needs 2 or 3", shape));
    if((shape == "outline" || shape == "axisymmetric") && domain.dimension != 2)
      throw prm.error(domain_keys, "dimension",
                      fmt::format("must be 2 for an {}",
                                  shape == "outline" ? shape : "axisymmetric section"));
    if((domain.dimension == 1) != (shape == "slab"))
      throw prm.error(domain_keys, "dimension",
                      shape == "slab" ? "must be 1 for a slab"
                                      : fmt::format("must be 2 or 3 for a {}", shape));
    if(shape == "slab")
    {
      domain.lower[0] = prm.get_number(domain_keys, "left end");
      domain.upper[0] = domain.lower[0] + prm.get_number(domain_keys, "length");
    }
    else if(shape == "ball" || shape == "shell")
      read_round_shape(prm, shape, domain);
    else if(shape == "outline")
      read_outline(prm, domain);
    else if(shape == "mesh")
      read_mesh(prm, domain);
    else
      read_rectangle(prm, shape, domain);
    return domain;
  }

  void check_symmetry(const PrmFile &prm, const Domain &domain, Symmetry symmetry)
  {
    const std::string shape = prm.get_text(domain_keys, "shape");
    const std::string word = prm.get_text("Scene", "symmetry");
    const auto complain = [&](const char *valid)
    {
      throw prm.error("Scene", "symmetry",
                      fmt::format("contradicts the domain: {} {} in {} dimension{} is "
                                  "{}, not {}",
                                  domain.outline || shape == "axisymmetric" ? "an" : "a",
                                  shape, domain.dimension,
                                  domain.dimension == 1 ? "" : "s", valid, word));
    };
    if(domain.shape == DomainShape::slab && symmetry != Symmetry::planar)
      complain("planar");
    if((domain.shape == DomainShape::box || domain.irregular()
        || domain.shape == DomainShape::axisymmetric)
       && symmetry != Symmetry::none)
      complain("none");
    if(domain.round() && symmetry != Symmetry::none
       && symmetry
              != (domain.dimension == 2 ? Symmetry::cylindrical : Symmetry::spherical))
      complain(domain.dimension == 2 ? "cylindrical or none" : "spherical or none");
  }
} // namespace meltfront::cases
