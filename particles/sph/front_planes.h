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

  /**
   * Signed distance of particles in the plane from the front, in spacings, negative in
   * the solid: the line that leaves in the square of three by three cells about the
   * particle the mean solid fraction of these cells. Its normal is the SPH gradient of
   * the solid fraction.
   *
   * One cell's own fraction would not do: when a front is oblique to the lattice, the
   * cells in a row across it do not melt as far as one line cuts them, only their sum
   * does.
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
      double along_x, along_y; ///< kernel weight times the difference of positions
    };

    double distance_of(std::size_t particle) const;

    std::vector<std::size_t> offsets;
    std::vector<Link> links;      ///< to the neighbours in the square
    std::vector<double> fraction; ///< of solid
    std::vector<double> distances;
  };
} // namespace meltfront::particles

#endif
