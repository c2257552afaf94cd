#ifndef meltfront_particles_core_arrangement_h
#define meltfront_particles_core_arrangement_h

#include <particles/core/particle_storage.h>

#include <array>
#include <cstdint>
#include <functional>
#include <span>

namespace meltfront::particles
{
  /** Where the particles of a lattice lie along one direction. */
  enum class LatticeLayout
  {
    cell_centred, ///< half a spacing inside both ends: n particles on n spacings
    on_edge       ///< on both ends: n particles on n - 1 spacings
  };

  /** One direction of a box that is filled with a lattice. */
  struct LatticeDirection
  {
    double lower = 0;
    double upper = 1;
    LatticeLayout layout = LatticeLayout::cell_centred;
    double spacing = 0; ///< its own (m); 0: the lattice's
  };

  /** Spacing of n particles on a length. @throws cases::InputError for too few. */
  double lattice_spacing(double length, int n, LatticeLayout layout);

  /**
   * A lattice that fills a box, cubic unless directions have spacings of their own: x, y,
   * z ascending with x the fastest.
   * @throws cases::InputError if a side is not a whole number of spacings, cases::Refusal
   * for more particles than can be numbered.
   */
  ParticleStorage arrange_in_box(int dimension,
                                 const std::array<LatticeDirection, 3> &directions,
                                 double spacing);

  /**
   * Points of a cubic lattice, symmetric about the origin, with
   * inner <= distance from the origin < outer: the particles of a disk or a ball
   * (inner = 0) or of a shell, or the rows of ghosts beyond their walls.
   * @throws cases::Refusal for more particles than can be numbered.
   */
  ParticleStorage arrange_in_shell(int dimension, double inner, double outer,
                                   double spacing, LatticeLayout layout);

  /**
   * Displace particles by uniform random amounts of at most `amplitude` (m) in each
   * direction; the same seed gives the same displacements on every machine. Particles for
   * which `movable` is false stay.
   */
  void jitter(ParticleStorage &particles, double amplitude, std::uint64_t seed,
              const std::function<bool(const std::array<double, 3> &)> &movable);

  /** Put particles at uniformly random places of a box; the same seed gives the same
   * places on every machine. @param chosen numbers of the particles that are moved */
  void scatter(ParticleStorage &particles, std::span<const std::uint32_t> chosen,
               const std::array<double, 3> &lower, const std::array<double, 3> &upper,
               std::uint64_t seed);
} // namespace meltfront::particles

#endif
