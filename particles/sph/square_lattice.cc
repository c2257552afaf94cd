#include <particles/sph/square_lattice.h>

#include <Eigen/LU>

#include <cmath>

namespace meltfront::particles
{
  SquareLattice::SquareLattice(const Discretisation &dis)
    : dis(dis)
    , scaled_walls(dis.walls)
    , scaled_periods(dis.periodicity)
  {
    if(!dis.stretched())
      return;
    scaled = dis.particles;
    for(int d = 0; d < dis.dimension; ++d)
    {
      const double scale = dis.spacing / dis.cell[d];
      for(double &x : scaled.position[d])
        x *= scale;
      scaled_periods.period[d] *= scale;
      for(PlaneWall &wall : scaled_walls)
        if(wall.direction == d)
          wall.coordinate *= scale;
    }
    find_strengths();
  }

  void SquareLattice::find_strengths()
  {
    const int reach = static_cast<int>(std::ceil(dis.kernel.support() / dis.spacing));
    const int reach_z = dis.dimension > 2 ? reach : 0;
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for(int i = -reach; i <= reach; ++i)
      for(int j = -reach; j <= reach; ++j)
        for(int k = -reach_z; k <= reach_z; ++k)
        {
          const Eigen::Vector3d squares(i * i, j * j, k * k);
          const double sum = squares.sum();
          const double distance = dis.spacing * std::sqrt(sum);
          if(sum > 0)
            moments -= dis.kernel.radial_derivative_over_distance(distance) / sum
                       * squares * squares.transpose();
        }
    // On squares each s_d is 1/V over the mean of the moments' rows.
    const int n = dis.dimension;
    Eigen::VectorXd wanted(n);
    for(int d = 0; d < n; ++d)
      wanted[d] = std::pow(dis.spacing / dis.cell[d], 2);
    const double of_squares = std::pow(dis.spacing, n) / dis.particle_volume;
    const Eigen::VectorXd found = moments.topLeftCorner(n, n).partialPivLu().solve(wanted)
                                  * moments.topLeftCorner(n, n).row(0).sum() * of_squares;
    for(int d = 0; d < n; ++d)
      strength[d] = found[d];
  }
} // namespace meltfront::particles
