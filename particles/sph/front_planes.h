#ifndef meltfront_particles_sph_front_planes_h
#define meltfront_particles_sph_front_planes_h

#include <particles/core/neighbour_list.h>
#include <particles/sph/discretisation.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace meltfront::particles
{
  class SquareLattice;

  /**
   * Signed distance of particles on a lattice in the plane or in space from the front, in
   * spacings (where cells are stretched, in the coordinates of SquareLattice), negative
   * in the solid: from the line (the plane) that leaves in the three
   * by three (by three) cells about the particle the mean solid fraction of these cells.
   * Its normal is the SPH gradient of the solid fraction.
   *
   * One cell's own fraction would not do: when a front is oblique to the lattice, the
   * cells in a row across it do not melt as far as one line cuts them, only their sum
   * does. Of a front of curvature kappa the line is the mean of an arc, whose middle lies
   * kappa w^2/24 beyond it, w the line's length in the square; in space kappa A/12, A the
   * plane's area in the cube and kappa the mean of the principal curvatures. It is fitted
   * to the distances of the particle and its neighbours, d + kappa t^2/2 along tangents.
   */
  class FrontPlanes
  {
  public:
    explicit FrontPlanes(const Discretisation &discretisation);

    /** Find the distances of the rows of some slices of an operator.
     * @param enthalpy J/kg, latent heat included */
    void update(std::span<const std::uint32_t> slices, const double *enthalpy,
                double latent_heat);

    /** By particle; those of rows outside of the slices of the last update() are not of
     * now. */
    const double *distance() const
    {
      return distances.data();
    }

    /** How far the cells about a particle show a single front, 0 to 1: none between two
     * fronts that all but touch, or where cells are beyond a wall that bends. */
    const double *trust() const
    {
      return trusts.data();
    }

    std::size_t bytes() const;

  private:
    using Vector = std::array<double, 3>;

    /** One of the steps from a cell to the cells about it. */
    struct Step
    {
      Vector step;   ///< spacings
      double weight; ///< of the kernel's gradient
    };

    struct Link
    {
      std::uint32_t neighbour;
      std::uint32_t step; ///< its number
    };

    /** The front in the cells about a particle. */
    struct Section
    {
      Vector normal{};      ///< into the liquid
      double distance = 0;  ///< of the particle
      double size = 0;      ///< length or area within the cells; 0: no single front
      double curvature = 0; ///< of the front, per spacing
      double trust = 0;     ///< in there being a single front
      long update = -1;     ///< at which it was found
    };

    /** The image of a particle beside plane walls, in some of them. */
    struct Image
    {
      std::uint32_t of;
      std::uint32_t inner; ///< the particle behind it, seen from the wall
      bool driven;         ///< a wall lets heat through
      cases::Position place;
    };

    void find_images(const SquareLattice &square, double spacing,
                     const NeighbourList &neighbours);
    double fraction_of(const Image &image) const;
    Section section_of(std::size_t particle) const;
    double trust_in(std::size_t particle, double mean, double gradient) const;
    double curvature_of(std::size_t particle) const;
    double beyond_section(std::size_t particle) const;

    /** Call visit(step, section) for each neighbour about which there is a front. */
    template <typename Visit>
    void visit_sections(std::size_t particle, const Visit &visit) const;

    int dimension;
    std::vector<Step> steps;
    double steepest; ///< gradient of a front along a lattice line
    std::vector<std::size_t> offsets;
    std::vector<Link> links;      ///< to the cells about a particle
    std::vector<Image> images;    ///< numbered after the particles
    std::vector<double> fraction; ///< of solid
    std::vector<Section> sections;
    std::vector<double> distances, trusts;
    long updates = 0;
  };
} // namespace meltfront::particles

#endif
