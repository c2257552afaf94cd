#ifndef meltfront_particles_sph_square_lattice_h
#define meltfront_particles_sph_square_lattice_h

#include <particles/sph/discretisation.h>

#include <array>
#include <vector>

namespace meltfront::particles
{
  /**
   * The particles, walls and periods of a discretisation in coordinates in which the
   * cells of its lattice are squares (cubes) of the side dp: each direction times
   * dp/dp_d. The scene's own unless cells are stretched so that they fill a box.
   *
   * Planes remain planes there, and distances from one keep their ratios, so what only
   * asks for these may forget the stretching. Conduction may not. A pair's coefficient
   *
   *   g_ab = 2 V^2 (-F_ab) sum_d s_d e_d^2,   e the direction between the two,
   *
   * r_ab, F_ab and e in these coordinates, makes the second moments of the lattice those
   * of a material that conducts alike in all directions, sum_b g_ab x_d x_d' = 2 V
   * delta_dd' in the scene's own: s solves sum_c M_dc s_c = (dp/dp_d)^2/V, where M_dc =
   * sum_b (-F_ab) e_c^2 x_d^2. (A pair's exchange by its direction: Espanol and Revenga
   * 2003.) By symmetry mixed moments vanish.
   */
  class SquareLattice
  {
  public:
    explicit SquareLattice(const Discretisation &discretisation);

    const ParticleStorage &particles() const
    {
      return dis.stretched() ? scaled : dis.particles;
    }

    const std::vector<PlaneWall> &walls() const
    {
      return scaled_walls;
    }

    const Periodicity &periodicity() const
    {
      return scaled_periods;
    }

    /** A length along a direction of the scene (m). */
    double in_scene(double length, int direction) const
    {
      return length * dis.cell[direction] / dis.spacing;
    }

    /** sum_d s_d e_d^2, over its value on a lattice of squares.
     * @param step between two particles; @param squared its length squared */
    double by_direction(const std::array<double, 3> &step, double squared) const
    {
      return dis.stretched()
                 ? (strength[0] * step[0] * step[0] + strength[1] * step[1] * step[1]
                    + strength[2] * step[2] * step[2])
                       / squared
                 : 1.;
    }

  private:
    void find_strengths();

    const Discretisation &dis;
    ParticleStorage scaled;
    std::vector<PlaneWall> scaled_walls;
    Periodicity scaled_periods;
    std::array<double, 3> strength{}; ///< s_d, over its value on a lattice of squares
  };
} // namespace meltfront::particles

#endif
