#ifndef meltfront_cases_case_file_mesh_reader_h
#define meltfront_cases_case_file_mesh_reader_h

#include <cases/case_file/prm_file.h>
#include <cases/scene.h>

namespace meltfront::cases
{
  /** Keys of domains of the shape `mesh`. */
  void declare_mesh(PrmFile &prm);

  /**
   * Read the mesh file that a domain of that shape names, or make the mesh of its
   * generator, and its bounding box.
   * @throws InputError for a file that is not there or that holds no mesh of this kind,
   * and for a generator's arguments that make none
   */
  void read_mesh(const PrmFile &prm, Domain &domain);

  /** @throws InputError if a file whose domain has another shape sets a key of a mesh. */
  void forbid_mesh_keys(const PrmFile &prm, const std::string &shape);

  /** Of an inclusion given by the name of a material of the mesh. */
  Inclusion read_mesh_inclusion(const PrmFile &prm, const std::string &here,
                                const Domain &domain);

  /** @throws InputError if the mesh has several materials and the case does not say of
   * each that it is the scene's or the inclusion's */
  void check_mesh_materials(const PrmFile &prm, const Scene &scene);
} // namespace meltfront::cases

#endif
