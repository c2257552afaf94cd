#ifndef meltfront_particles_rkpm_tracked_plane_front_h
#define meltfront_particles_rkpm_tracked_plane_front_h

#include <particles/rkpm_tracked/plane/bins.h>

#include <vector>

namespace meltfront::particles::rkpm_tracked
{
  /** Distance of front particles along their curves, in spacings of the nodes. */
  inline constexpr double front_spacing = 1.15;

  /**
   * Particles on the front, ordered along closed curves with the solid on the left: a
   * body of solid is gone round counter-clockwise, a body of liquid clockwise. Curves may
   * reach beyond the domain; particles out there are not active.
   */
  struct PlaneFront
  {
    std::vector<std::size_t> offsets{0}; ///< curve c has offsets[c] <= p < offsets[c + 1]
    std::vector<PlanePoint> position;
    std::vector<PlanePoint> normal; ///< into the solid
    std::vector<double> curvature;  ///< 1/m, positive where the solid is convex
    std::vector<double> speed;      ///< along the normal (m/s), positive for melting
    std::vector<PlanePoint> displacement; ///< of the last time step (m)
    std::vector<char> active;             ///< within the domain

    std::size_t size() const
    {
      return position.size();
    }

    std::size_t curves() const
    {
      return offsets.size() - 1;
    }

    /** The particle after (before) another one along its curve. */
    std::size_t next(std::size_t curve, std::size_t particle) const
    {
      return particle + 1 < offsets[curve + 1] ? particle + 1 : offsets[curve];
    }
    std::size_t previous(std::size_t curve, std::size_t particle) const
    {
      return particle > offsets[curve] ? particle - 1 : offsets[curve + 1] - 1;
    }

    /** Append a closed curve, at rest. */
    void add_curve(std::span<const PlanePoint> points);

    /** Take a curve out. */
    void remove_curve(std::size_t curve);
  };

  /** Normals and curvatures from a periodic cubic spline through each curve. */
  void update_geometry(PlaneFront &front);

  /** Shortest and longest distance of neighbours along the curves (m). */
  struct SpacingRange
  {
    double least, largest;
  };
  SpacingRange spacing_range(const PlaneFront &front);

  /** Fewest particles on a curve. */
  inline constexpr std::size_t fewest_on_curve = 8;

  /** Place a curve's particles at equal distances along its spline, near the target (m),
   * so that it encloses the same area as before, with speeds and displacements
   * interpolated; normals and curvatures anew. */
  void redistribute(PlaneFront &front, std::size_t curve, double target);

  /** The same of all curves of which a distance has left the range (in targets). @return
   * how many */
  std::size_t redistribute(PlaneFront &front, double target, double least,
                           double largest);

  /** Area that a curve encloses, of the spline (m^2); negative if it goes clockwise. */
  double signed_area(const PlaneFront &front, std::size_t curve);

  /** Move a curve's particles along their normals, all alike, so that it encloses an area
   * (m^2) but for the square of the move. */
  void restore_area(PlaneFront &front, std::size_t curve, double area);

  /** m, of the spline's polygon. */
  double curve_length(const PlaneFront &front, std::size_t curve);

  /** Points on the splines: each piece divided evenly, with all curves closed. */
  struct FrontPolygon
  {
    FrontPolygon() = default;

    /** @param parts into which each piece between two particles is divided */
    FrontPolygon(const PlaneFront &front, int parts);

    std::vector<std::size_t> offsets{0};
    std::vector<PlanePoint> vertices;
  };

  /** A place on a FrontPolygon: `share` of the way from a vertex to the one after it. */
  struct FrontPlace
  {
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    std::size_t vertex = none, following = none;
    double share = 0;
    double square = 0; ///< of the distance from the point that was asked for (m^2)
  };

  /** Vectors of the particles, splines between them, at the vertices of a FrontPolygon of
   * FrontIndex::parts_of_piece. */
  std::vector<PlanePoint> along_polygon(const PlaneFront &front,
                                        const std::vector<PlanePoint> &values);

  /** Who is where: winding numbers and distances, from the polygons of the splines. */
  class FrontIndex
  {
  public:
    /** Parts of each piece of the spline, for areas and distances: chords then leave the
     * curve by a hundredth of what those between particles do. */
    static constexpr int parts_of_piece = 8;

    /**
     * @param solid_beyond whether what no curve encloses is solid
     * @param cell side of the search's cells (m), about the particles' distance
     */
    FrontIndex(const PlaneFront &front, bool solid_beyond, double cell);

    FrontIndex(const FrontIndex &) = delete;
    FrontIndex &operator=(const FrontIndex &) = delete;

    /** How often curves go round a point, counter-clockwise less clockwise, and one more
     * where what no curve encloses is solid. */
    int winding(const PlanePoint &place) const;

    /** Solid is where that is more than none: two overlapping bodies are one. */
    bool solid(const PlanePoint &place) const
    {
      return winding(place) > 0;
    }

    /**
     * Distance to the front, negative in solid (m).
     * @param reach beyond which only the sign and `reach` are returned
     */
    double signed_distance(const PlanePoint &place, double reach) const;

    /** The nearest place on the front within a reach (m). */
    FrontPlace closest(const PlanePoint &place, double reach) const;

    /** Whether the way between two points leads through pieces of the front that face
     * each other, however near to each other; not so where it cuts across a bend. */
    bool film_between(const PlanePoint &from, const PlanePoint &to) const;

  private:
    FrontPolygon polygon;
    bool solid_beyond;
    double cell, bottom = 0, longest = 0;
    std::vector<std::uint32_t> following; ///< vertex at the end of each vertex's piece
    std::vector<std::size_t> band_offsets;
    std::vector<std::uint32_t> band_pieces; ///< by rows of cells
    PlaneBins bins;
  };
} // namespace meltfront::particles::rkpm_tracked

#endif
