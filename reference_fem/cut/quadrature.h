#ifndef meltfront_reference_fem_cut_quadrature_h
#define meltfront_reference_fem_cut_quadrature_h

#include <reference_fem/cut/background_mesh.h>

#include <deal.II/lac/vector.h>

#include <array>
#include <memory>
#include <vector>

namespace meltfront::reference_fem::cut
{
  /** The two sides of a level set in one cell and the curve between them. */
  struct CutQuadrature
  {
    std::vector<VolumePoint> inside; ///< where the level set is negative
    std::vector<VolumePoint> outside;
    std::vector<SurfacePoint> surface; ///< normals point outside
  };

  /** Classifies cells by a discrete level set and integrates over the parts of those
   * that it cuts (deal.II's NonMatching classes, method of Saye 2015). */
  class CutIntegrator
  {
  public:
    /** @param level_set at the degrees of freedom of the mesh's level set */
    CutIntegrator(const BackgroundMesh &mesh, const Values &level_set);
    ~CutIntegrator();

    enum class Side : char
    {
      inside,
      outside,
      cut
    };
    const std::vector<Side> &sides() const
    {
      return by_cell;
    }

    CutQuadrature integrate(unsigned int cell);

  private:
    struct Generator;
    const BackgroundMesh &mesh;
    const dealii::Vector<double> values;
    std::vector<Side> by_cell;
    std::unique_ptr<Generator> generator;
  };

  /** Gauss points of a cell; three per direction integrate products of its elements. */
  std::vector<VolumePoint> whole_cell(const Cell &cell,
                                      unsigned int points_per_direction = 3);
} // namespace meltfront::reference_fem::cut

#endif
