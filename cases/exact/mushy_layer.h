#ifndef meltfront_cases_exact_mushy_layer_h
#define meltfront_cases_exact_mushy_layer_h

#include <cases/alloy.h>
#include <cases/exact/mushy_layer_diffusing.h>
#include <cases/exact_solution.h>

#include <memory>
#include <vector>

namespace meltfront::cases
{
  /**
   * Freezing of an alloy that fills the half space x > 0 at rest, from a wall held at a
   * temperature below its liquidus: a mush grows behind a front 2 lambda sqrt(a t), a the
   * thermal diffusivity of the liquid (ideal mushy layer, see mushy_layer_profile.h).
   *
   * Without diffusion every place keeps its solute and the lever rule holds; where the
   * wall is colder than the eutectic temperature, solid follows the mush. With diffusion
   * the front is in marginal equilibrium, the liquid ahead of it is enriched, and a thin
   * layer at the wall loses all of its solute. Two solutes act by the sum of what they
   * lower the liquidus by; those that diffuse must diffuse equally.
   *
   * Crystals do not displace liquid; their density counts where conductivities are mixed,
   * and solute diffuses through the mass of liquid that is there.
   */
  class MushyLayer : public ExactSolution
  {
  public:
    /**
     * @param concentration  mass fraction of each solute far away
     * @param conduction  of the mush; `published` for what a method repeats as printed
     * @throws InputError for properties that are not positive, phases of different
     * densities, a wall that is not below the liquidus, a far temperature that is not
     * above it, solutes that diffuse unequally, or, where they diffuse, a curved
     * liquidus, a wall below the eutectic temperature, or data of which no mush forms.
     */
    MushyLayer(const Material &material, const Alloy &alloy,
               const std::vector<double> &concentration, double wall_temperature,
               double far_temperature,
               similarity::HeatOfFreezing heat = similarity::HeatOfFreezing::consistent,
               similarity::MushConduction conduction = similarity::MushConduction::mean);
    ~MushyLayer() override;

    /** The front constant. */
    double lambda() const;

    /** Mass fraction of the first solute in the liquid at the front. */
    double front_concentration() const;

    /** Heat that has come in through the wall since the start (J/m^2), negative. */
    double wall_heat(double time) const;

    std::string description() const override;
    Symmetry symmetry() const override;
    double front(double time) const override;
    bool mushy() const override;

    using ExactSolution::temperature;
    double temperature(double coordinate, double time) const override;
    double solid_fraction(double coordinate, double time) const override;
    double concentration(double coordinate, double time) const override;

    /** The same of any of the solutes. */
    double concentration(std::size_t solute, double coordinate, double time) const;

    /** Integrated with the profile itself, to about 1e-13 of the heat up to `upper`. */
    double heat_content(double lower, double upper, double time) const override;
    double solid_volume(double lower, double upper, double time) const override;

  private:
    struct Profile;

    /** 2 sqrt(a t), the unit of eta (m). */
    double length(double time) const;

    Material material;
    std::vector<double> far_concentration;
    similarity::Mush<double> mush;
    std::unique_ptr<const Profile> profile;
  };
} // namespace meltfront::cases

#endif
