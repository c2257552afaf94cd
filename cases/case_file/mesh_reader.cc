#include <cases/case_file/generated_mesh.h>
#include <cases/case_file/key_builders.h>
#include <cases/case_file/mesh_reader.h>
#include <cases/gmsh_file.h>
#include <cases/options.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace meltfront::cases
{
  namespace
  {
    const std::string file_of_mesh = "file", materials_of_scene = "materials";
    const std::string generator_key = "generator",
                      generator_arguments = "generator arguments",
                      generator_halvings = "generator halvings";

    /** More make more cells than there may be of any generator. */
    constexpr int most_halvings = 9;

    /** The key that says what the mesh is. */
    std::string source_of_mesh(const PrmFile &prm)
    {
      return prm.given(domain_keys, generator_key) ? generator_key : file_of_mesh;
    }

    /** The index of a material of the mesh, by its name in a key. */
    unsigned int material_of(const PrmFile &prm, const std::string &here,
                             const std::string &key, const BodyMesh &mesh,
                             const std::string &name)
    {
      const auto found = std::ranges::find(mesh.materials(), name);
      if(found == mesh.materials().end())
        throw prm.error(here, key,
                        fmt::format("names the material '{}', which the mesh lacks; it "
                                    "has {}",
                                    quotable(name), fmt::join(mesh.materials(), ", ")));
      return static_cast<unsigned int>(found - mesh.materials().begin());
    }

    BodyMeshData read_mesh_file(const PrmFile &prm, const std::string &name,
                                int dimension)
    {
      for(const std::string &key : {generator_arguments, generator_halvings})
        prm.forbid(domain_keys, key, "the mesh is that of a file");
      try
      {
        return read_gmsh(prm.attached(domain_keys, file_of_mesh), name, dimension);
      }
      catch(const InputError &error)
      {
        throw prm.error(domain_keys, file_of_mesh,
                        fmt::format("cannot be used: {}", error.what()));
      }
    }

    BodyMeshData read_generated_mesh(const PrmFile &prm, int dimension)
    {
      prm.forbid(domain_keys, file_of_mesh, "the mesh is a generator's");
      const std::string name = prm.get_text(domain_keys, generator_key);
      const MeshGenerator &generator = *std::ranges::find(
          mesh_generators(), name,
          [](const MeshGenerator &known) { return std::string_view(known.name); });
      if(!std::ranges::count(generator.dimensions, dimension))
        throw prm.error(domain_keys, generator_key,
                        fmt::format("names {}, which makes no mesh in {} dimensions",
                                    name, dimension));
      prm.require(
          domain_keys, generator_arguments,
          fmt::format("{} needs {}", name, arguments_in_words(generator, dimension)));
      const int halvings
          = static_cast<int>(prm.get_integer(domain_keys, generator_halvings));
      GeneratedMesh mesh;
      try
      {
        mesh = generate_mesh(generator, dimension,
                             prm.get_text(domain_keys, generator_arguments), halvings);
      }
      catch(const InputError &error)
      {
        throw prm.error(domain_keys, generator_arguments, error.what());
      }
      if(mesh.curved)
        prm.require(domain_keys, generator_halvings,
                    fmt::format("a {} is curved, and the body is what its cells fill "
                                "once they were halved so often along the curve",
                                name));
      return std::move(mesh.cells);
    }
  } // namespace

  void declare_mesh(PrmFile &prm)
  {
    prm.declare(
        domain_keys,
        file_key(file_of_mesh,
                 "Of a mesh: a file of gmsh (text, format 2.2 or 4.1) beside this "
                 "one, with linear triangles, quadrilaterals, tetrahedra or "
                 "hexahedra. Its physical groups are walls and materials."));
    std::vector<std::string> names;
    for(const MeshGenerator &generator : mesh_generators())
      names.push_back(generator.name);
    prm.declare(domain_keys,
                word_key(generator_key, "", names,
                         "Of a mesh, in place of a file: a function of deal.II's "
                         "GridGenerator. The numbers that it gives boundaries and cells "
                         "are walls and materials."));
    prm.declare(domain_keys,
                text_key(generator_arguments,
                         "All of the generator's arguments in SI units, separated by "
                         "colons, as deal.II's manual lists them: '0, 0 : 0.1 : 0.2 : 16 "
                         ": true' of a hyper_shell."));
    prm.declare(domain_keys,
                integer_key(generator_halvings, "0", 0, most_halvings,
                            "How often the edges of the generator's cells are halved "
                            "along its curves; what the cells fill then is the body. A "
                            "curved one needs it."));
    prm.declare(domain_keys,
                text_key(materials_of_scene,
                         "Of a mesh with several materials: those, separated by commas, "
                         "that are the scene's."));
  }

  void read_mesh(const PrmFile &prm, Domain &domain)
  {
    domain.shape = DomainShape::mesh;
    const std::string key = source_of_mesh(prm);
    if(key == file_of_mesh)
      prm.require(domain_keys, key, "a mesh needs it, or the key 'generator'");
    const std::string name = quotable(prm.get_text(domain_keys, key));
    BodyMeshData data = key == file_of_mesh ? read_mesh_file(prm, name, domain.dimension)
                                            : read_generated_mesh(prm, domain.dimension);
    const auto complain = [&](const std::string &problem)
    {
      return prm.error(domain_keys, key,
                       fmt::format("cannot be used: {}: {}", name, problem));
    };
    if(data.walls.size() > most_mesh_walls)
      throw complain(fmt::format(
          "the boundary has {} {}, and there may be {}", data.walls.size(),
          key == file_of_mesh ? "physical groups" : "numbers", most_mesh_walls));
    try
    {
      domain.mesh = std::make_shared<const BodyMesh>(std::move(data));
    }
    catch(const InputError &error)
    {
      throw complain(fmt::format("the mesh {}", error.what()));
    }
    domain.lower = domain.mesh->lower();
    domain.upper = domain.mesh->upper();
    for(int d = 0; d < domain.dimension; ++d)
      domain.reference_length
          = std::max(domain.reference_length, domain.upper[d] - domain.lower[d]);
  }

  void forbid_mesh_keys(const PrmFile &prm, const std::string &shape)
  {
    for(const std::string &key : {file_of_mesh, materials_of_scene, generator_key,
                                  generator_arguments, generator_halvings})
      prm.forbid(domain_keys, key, fmt::format("the shape is a {}", shape));
  }

  Inclusion read_mesh_inclusion(const PrmFile &prm, const std::string &here,
                                const Domain &domain)
  {
    const std::string name = prm.get_text(here, "material");
    if(!domain.mesh)
      throw prm.error(here, "material", "has a meaning in a domain of the shape 'mesh'");
    prm.forbid(here, "level set", "the inclusion is a material of the mesh");
    const unsigned int material = material_of(prm, here, "material", *domain.mesh, name);
    const Field level_set{fmt::format("cells of '{}'", name),
                          [mesh = domain.mesh, material](const Position &p, double)
                          {
                            const auto cell = mesh->cell_at(p);
                            return cell && mesh->material_of_cell(*cell) == material ? -1.
                                                                                     : 1.;
                          }};
    return {level_set, prm.get_number(here, "conductivity"), material};
  }

  void check_mesh_materials(const PrmFile &prm, const Scene &scene)
  {
    if(!scene.domain.mesh)
      return;
    const BodyMesh &mesh = *scene.domain.mesh;
    std::vector<bool> known(mesh.materials().size(), mesh.materials().size() == 1);
    if(prm.given(domain_keys, materials_of_scene))
      for(const std::string &name :
          split_list(prm.get_text(domain_keys, materials_of_scene), ','))
        known[material_of(prm, domain_keys, materials_of_scene, mesh, name)] = true;
    if(scene.inclusion && scene.inclusion->material)
      known[*scene.inclusion->material] = true;
    const auto unknown = std::ranges::find(known, false);
    if(unknown != known.end())
      throw prm.error(
          domain_keys, source_of_mesh(prm),
          fmt::format(
              "has the materials {}; '{}' is neither named in the key 'materials', "
              "as one of those that are the scene's, nor is it the inclusion's",
              fmt::join(mesh.materials(), ", "),
              mesh.materials()[static_cast<std::size_t>(unknown - known.begin())]));
  }
} // namespace meltfront::cases
