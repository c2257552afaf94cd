#ifndef meltfront_reference_fem_enthalpy_liquid_motion_h
#define meltfront_reference_fem_enthalpy_liquid_motion_h

#include <cases/method.h>
#include <cases/scene.h>
#include <reference_fem/enthalpy/mesh.h>

#include <vector>

namespace meltfront::reference_fem
{
  /**
   * The effect liquid_motion in a slab: solid lies at rest at x_min, and the liquid
   * beyond it gives way to, or follows, a solid of another density through the open end
   * x_max.
   *
   * The coordinate X with rho_s dX = rho dx, counted from x_min, moves with the matter:
   * in it both phases are at rest with the solid's density, and liquid conducts with k_l
   * rho_l/rho_s. Of the slab's length L a solid of thickness s leaves liquid up to
   *
   *   X = (rho_l/rho_s) L + (1 - rho_l/rho_s) s,
   *
   * the open end. The nodes that are well within the liquid follow it after every step;
   * what their cells gain and lose by that is taken from linear profiles (minmod), to
   * round-off. What passes the end is liquid at the wall's temperature; its heat counts
   * as the wall's.
   */
  class LiquidMotion
  {
  public:
    /** @throws cases::Refusal where there is solid beyond liquid at the start */
    explicit LiquidMotion(const cases::Scene &in_space);

    LiquidMotion(const LiquidMotion &) = delete;
    LiquidMotion &operator=(const LiquidMotion &) = delete;

    /** The same in X, with the end where it is at the start. */
    const cases::Scene &at_rest() const
    {
      return scene;
    }

    /** Heat that came in through the open end by its motion (J/m^2), of the state at hand
     * and of that one step before, which is moved likewise. */
    struct Entered
    {
      double now = 0, before = 0;
      std::size_t first; ///< of the nodes whose cells have changed
    };

    /**
     * Move the end to where the state wants it.
     * @param enthalpy per volume by node (J/m^3), and that one step before
     * @throws cases::Refusal where solid lies beyond liquid, or hardly any liquid is left
     */
    Entered move(Discretisation &mesh, std::vector<double> &enthalpy,
                 std::vector<double> &enthalpy_before, double time);

    /** Put the sites where they are in space, with the volumes and the shares of solid
     * that they have there. */
    void return_to_space(const Discretisation &mesh, cases::Snapshot &snapshot);

    cases::EffectCost cost() const;

  private:
    double thickness_of_solid(const cases::Scene &in_space) const;
    std::size_t first_to_move(const Discretisation &mesh,
                              const std::vector<double> &enthalpy, double time) const;
    double solid_fraction(double enthalpy) const;

    double lowest, length; ///< of the slab (m)
    double density_ratio;  ///< rho_l/rho_s
    cases::Scene scene;
    std::vector<double> place, width, share; ///< of the sites, in space
    long calls = 0;
    double seconds = 0;
  };
} // namespace meltfront::reference_fem

#endif
