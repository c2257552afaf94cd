#include <cases/case_file/key_builders.h>
#include <cases/case_file/mesh_reader.h>
#include <cases/gmsh_file.h>
#include <cases/options.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace meltfront::cases
{
  namespace
  {
    const std::string file_of_mesh = "file", materials_of_scene = "materials";

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
  } // namespace

  void declare_mesh(PrmFile &prm)
  {
    prm.declare(
        domain_keys,
        file_key(file_of_mesh,
                 "Of a mesh: a file of gmsh (text, format 2.2 or 4.1) beside this "
                 "one, with linear triangles, quadrilaterals, tetrahedra or "
                 "hexahedra. Its physical groups are walls and materials."));
    prm.declare(domain_keys,
                text_key(materials_of_scene,
                         "Of a mesh with several materials: those, separated by commas, "
                         "that are the scene's."));
  }

  void read_mesh(const PrmFile &prm, Domain &domain)
  {
    prm.require(domain_keys, file_of_mesh, "a mesh needs it");
    domain.shape = DomainShape::mesh;
    const std::string name = prm.get_text(domain_keys, file_of_mesh);
    const auto complain = [&](const std::string &problem)
    {
      return prm.error(domain_keys, file_of_mesh,
                       fmt::format("cannot be used: {}", problem));
    };
    BodyMeshData data;
    try
    {
      data = read_gmsh(prm.attached(domain_keys, file_of_mesh), quotable(name),
                       domain.dimension);
    }
    catch(const InputError &error)
    {
      throw complain(error.what());
    }
    if(data.walls.size() > most_mesh_walls)
      throw complain(fmt::format("{}: the boundary has {} physical groups, and there may "
                                 "be {}",
                                 quotable(name), data.walls.size(), most_mesh_walls));
    try
    {
      domain.mesh = std::make_shared<const BodyMesh>(std::move(data));
    }
    catch(const InputError &error)
    {
      throw complain(fmt::format("{}: the mesh {}", quotable(name), error.what()));
    }
    domain.lower = domain.mesh->lower();
    domain.upper = domain.mesh->upper();
    for(int d = 0; d < domain.dimension; ++d)
      domain.reference_length
          = std::max(domain.reference_length, domain.upper[d] - domain.lower[d]);
  }

  void forbid_mesh_keys(const PrmFile &prm, const std::string &shape)
  {
    for(const std::string &key : {file_of_mesh, materials_of_scene})
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
          domain_keys, file_of_mesh,
          fmt::format(
              "has the materials {}; '{}' is neither named in the key 'materials', "
              "as one of those that are the scene's, nor is it the inclusion's",
              fmt::join(mesh.materials(), ", "),
              mesh.materials()[static_cast<std::size_t>(unknown - known.begin())]));
  }
} // namespace meltfront::cases
