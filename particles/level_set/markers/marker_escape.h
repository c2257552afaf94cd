#ifndef meltfront_particles_level_set_markers_marker_escape_h
#define meltfront_particles_level_set_markers_marker_escape_h

#include <particles/level_set/markers/marker_storage.h>

#include <cstdint>
#include <span>
#include <vector>

namespace meltfront::particles::level_set
{
  /** What an escaped marker says about the nodes near it. */
  enum class EscapeRule
  {
    spheres, ///< the signed distance of its sphere, at the corners of its cell
    normals  ///< signed by the side on which the node lies, at the 4 x 4 nodes around it
  };

  /** How what escaped markers say is merged with the grid's value. */
  enum class EscapeMerge
  {
    smaller_magnitude, ///< whichever is nearest to zero, the grid's own value among them
    replace ///< whichever of the markers' is nearest to zero, whatever the grid's
  };

  struct EscapeParameters
  {
    EscapeRule rule = EscapeRule::spheres;
    EscapeMerge merge = EscapeMerge::smaller_magnitude; ///< only of rule normals
    double band = 5;        ///< nodes further from the grid's front are left (spacings)
    double alignment = 0.9; ///< least cosine between the normal and the way to the node
  };

  /**
   * Corrects a level set by markers found on the wrong side of the front by more than
   * their radius, s phi(x_p) < -r.
   *
   * Rule `spheres` (Enright, Fedkiw, Ferziger, Mitchell 2002), equations (4.11) to (4.15)
   * of the report: phi_p = s (r - |x - x_p|), largest of the positive and smallest of the
   * negative ones with phi itself, then the one of smaller magnitude.
   *
   * Rule `normals`, the idea of Wang, Yang, Stern (2009), whose text we did not have:
   * phi_p = s (r + sign(delta) |x - x_p|), delta = (x - x_p) . m, m = s grad phi/|grad
   * phi| into the marker's own phase, where |delta| >= alignment |x - x_p|; per node and
   * sign the marker of smallest tangential offset counts.
   */
  class EscapeCorrection
  {
  public:
    EscapeCorrection(const Grid &grid, const EscapeParameters &parameters, int threads);

    /**
     * @param markers with signed radii for distances; their order does not matter
     * @param phi at all nodes (m)
     * @returns how many markers had escaped
     */
    std::size_t correct(const Markers &markers, std::span<double> phi);

    /** Take the radii of markers that have not escaped from the level set. */
    void reset_radii(Markers &markers, std::span<const double> phi);

  private:
    void find_depths(const Markers &markers, std::span<const double> phi);
    void find_escaped(const Markers &markers, std::span<const double> phi);
    void add_spheres(const Markers &markers, std::size_t marker,
                     std::span<const double> phi);
    void add_normals(const Markers &markers, std::size_t marker,
                     std::span<const double> phi);
    void add_by_offset(std::size_t node, bool positive, double value, double aside);
    bool first_touch(std::size_t node);
    void merge(std::span<double> phi);

    const Grid grid;
    const EscapeParameters parameters;
    const int threads;
    std::vector<double> depth; ///< s phi(x_p) by marker (m)
    std::vector<std::uint32_t> escaped;
    std::vector<std::uint8_t> touched; ///< by node
    std::vector<std::uint32_t> nodes;  ///< that escaped markers speak about
    /** By node, what negative and positive markers say, and from which offset. */
    std::array<std::vector<double>, 2> said, offset;
  };
} // namespace meltfront::particles::level_set

#endif
