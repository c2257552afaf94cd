#ifndef meltfront_particles_sph_front_planes_h
#define meltfront_particles_sph_front_planes_h

#include <particles/core/neighbour_list.h>
#include <particles/sph/discretisation.h>

#include <cstdint>
#include <span>
#include <vector>

namespace meltfront::particles
{
  /** Where a line with a unit normal cuts a unit square so that a given part of it lies
   * behind: signed distance from the square's centre along the normal (1). */
  double line_through_square(double part_behind, double normal_x, double normal_y);

  /** Length within a unit square of the line with a unit normal at a distance from its
   * centre; 0 for one that misses it. */
  double length_in_square(double distance, double normal_x, double normal_y);

  /**
   * Signed distance of particles in the plane from the front, in spacings, negative in
   * the solid: the line that leaves in the square of three by three cells about the
   * particle the mean solid fraction of these cells. Its normal is the SPH gradient of
   * the solid fraction.
   *
   * One cell's own fraction would not do: when a front is oblique to the lattice, the
   * cells in a row across it do not melt as far as one line cuts them, only their sum
   * does. Of a front of curvature kappa the line is the mean of an arc whose middle lies
   * kappa w^2/24 beyond it, w the line's length in the square: the curvature is fitted to
   * the distances of the particle and its neighbours, d + kappa t^2/2 along the tangent.
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

    std::size_t bytes() const;

  private:
    struct Link
    {
      std::uint32_t neighbour;
      double x, y;   ///< difference of positions, in spacings
      double weight; ///< of the kernel's gradient
    };

    /** The line through the square about a particle. */
    struct Line
    {
      double normal_x = 0, normal_y = 0; ///< into the liquid
      double distance = 0;               ///< of the particle
      double length = 0;                 ///< within the square; 0: there is none
      double curvature = 0;              ///< of the front, per spacing
      long update = -1;                  ///< at which it was found
    };

    /** The image of a particle beside a plane wall, in its wall. */
    struct Image
    {
      std::uint32_t of;
      std::uint32_t inner; ///< the particle behind it, seen from the wall
      bool driven;         ///< the wall lets heat through
      cases::Position place;
    };

    void find_images(const Discretisation &discretisation,
                     const NeighbourList &neighbours);
    double fraction_of(const Image &image) const;
    Line line_of(std::size_t particle) const;
    double curvature_of(std::size_t particle) const;
    double beyond_line(std::size_t particle) const;

    /** Call visit(link, line) for each neighbour about which there is a line. */
    template <typename Visit>
    void visit_lines(std::size_t particle, const Visit &visit) const;


    std::vector<std::size_t> offsets;
    std::vector<Link> links;      ///< to the neighbours in the square
    std::vector<Image> images;    ///< numbered after the particles
    std::vector<double> fraction; ///< of solid
    std::vector<Line> lines;
    std::vector<double> distances;
    long updates = 0;
  };
} // namespace meltfront::particles

#endif
