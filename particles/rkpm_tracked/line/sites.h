#ifndef meltfront_particles_rkpm_tracked_line_sites_h
#define meltfront_particles_rkpm_tracked_line_sites_h

#include <cases/snapshot.h>
#include <particles/rkpm_tracked/line/problem.h>

namespace meltfront::particles::rkpm_tracked
{
  /** Heat in the domain above solid at the melting temperature, in the measure of the
   * scene. */
  struct LineHeat
  {
    double sensible = 0, latent = 0;

    double total() const
    {
      return sensible + latent;
    }
  };

  /** The heat of a state; temperatures are straight between neighbouring points. */
  LineHeat heat_of(const LineProblem &problem, const LineState &state);

  /** Heat that comes in through the walls per time, in the measure of the scene; with
   * liquid or solid that moves through them. */
  double wall_heat(const LineProblem &problem, const LineState &state);

  /** Heat that walls' fluxes that vary bring in over a time (J), which wall_heat() leaves
   * out. */
  double given_wall_heat(const LineProblem &problem, double begin, double end);

  /** A state as sites: nodes and fronts in ascending order. A node stands for what is
   * nearer to it than to its neighbours, up to the front; so the solid's volume is that
   * between the fronts. */
  class LineSites
  {
  public:
    void read(const LineProblem &problem, const LineState &state,
              cases::Snapshot &snapshot);

  private:
    void add(double place, double weight, double temperature, bool solid);

    std::vector<double> place, weight, temperature, solid_fraction, fronts;
  };
} // namespace meltfront::particles::rkpm_tracked

#endif
