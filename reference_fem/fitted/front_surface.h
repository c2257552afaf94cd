#ifndef meltfront_reference_fem_fitted_front_surface_h
#define meltfront_reference_fem_fitted_front_surface_h

#include <cases/position.h>

#include <Eigen/Core>

#include <array>
#include <vector>

namespace meltfront::reference_fem::fitted
{
  /** Lagrange polynomials through the Gauss-Lobatto points of [0, 1], at given points. */
  struct LineBasis
  {
    LineBasis(int degree, const std::vector<double> &points);

    Eigen::MatrixXd value;      ///< by point and polynomial
    Eigen::MatrixXd derivative; ///< by point and polynomial
  };

  /** The Gauss-Lobatto points of [0, 1] through which the polynomials of a degree go. */
  std::vector<double> node_shares(int degree);

  /** A point of the surface that carries the rays: x = base + r direction on its ray. */
  struct SurfacePoint
  {
    cases::Position base{}, direction{};
    double measure = 1; ///< of the surface at r = 1, per area of the reference cell
    /** Components of the surface gradient at r = 1 along two orthogonal tangents: they
     * take the derivatives with respect to the cell's coordinates. */
    Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero();
  };

  /** Quadrature on the surface, with everything that is fixed while the front moves. */
  struct SurfaceRule
  {
    struct Cell
    {
      Eigen::ArrayXd weight; ///< surface at r = 1
      /** psi_a along each tangent, by point and ray of the cell. */
      std::array<Eigen::MatrixXd, 2> gradient;
      std::vector<SurfacePoint> points;
    };

    Eigen::MatrixXd value; ///< psi_a by point and ray, the same in all cells
    std::vector<Cell> cells;
  };

  /**
   * The mesh along the front, of dimension d - 1: a point, a line across a box, a circle,
   * a face of a box or a sphere made of six faces of a cube (equiangular, Ronchi, Iacono
   * and Paolucci 1996). Its nodes carry the rays on which the nodes of the domain lie.
   *
   * Circles and spheres are exact, not interpolated: what depends on the radius alone is
   * solved in 2D and 3D as it is in one dimension.
   */
  class FrontSurface
  {
  public:
    /** One ray along x; areas are @p area r^@p exponent. */
    static FrontSurface point(int degree, double area, int exponent);
    static FrontSurface circle(int degree, int cells);
    static FrontSurface sphere(int degree, int cells_per_edge);
    /** Rays along x through a line of @p cells cells along y. */
    static FrontSurface line(int degree, int cells, double lower, double upper,
                             bool periodic);
    /** Rays along x through the rectangle of y and z. */
    static FrontSurface rectangle(int degree, const std::array<int, 2> &cells,
                                  const cases::Position &lower,
                                  const cases::Position &upper,
                                  const std::array<bool, 2> &periodic);

    int degree = 1;
    int tangents = 0; ///< d - 1
    int exponent = 0; ///< m of areas r^m
    bool round = false;
    std::vector<cases::Position> base, direction; ///< by ray
    /** Rays of each cell in lexicographic order. */
    std::vector<std::vector<unsigned int>> cells;

    unsigned int n_rays() const
    {
      return static_cast<unsigned int>(base.size());
    }

    /** Gauss quadrature with so many points along each coordinate of a cell. */
    SurfaceRule rule(int points) const;

  private:
    /** A cell's place: lower corner and widths in the coordinates of its face. */
    struct Patch
    {
      int face = 0;
      std::array<double, 2> lower{}, width{1, 1};
    };

    static FrontSurface tensor(int degree, const std::array<int, 2> &cells, int tangents,
                               const cases::Position &lower, const cases::Position &upper,
                               const std::array<bool, 2> &periodic);
    SurfacePoint at(const Patch &patch, double u, double v) const;
    void add_cell(const Patch &patch, const std::vector<unsigned int> &rays);

    enum class Kind
    {
      point,
      flat,
      circle,
      sphere
    };

    Kind kind = Kind::point;
    double area = 1; ///< of a point
    std::vector<Patch> patches;
  };
} // namespace meltfront::reference_fem::fitted

#endif
