#ifndef meltfront_cases_exact_varying_neumann_h
#define meltfront_cases_exact_varying_neumann_h

#include <cases/exact_solution.h>
#include <cases/material.h>

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace meltfront::cases
{
  /** A substance whose properties depend on temperature (K), that melts at one
   * temperature or over a range. */
  struct VaryingMaterial
  {
    using Property = std::function<double(double temperature)>;

    Property solid_conductivity, liquid_conductivity; ///< W/(m K)
    Property solid_capacity, liquid_capacity;         ///< per volume, J/(m^3 K)
    double latent_heat = 1;                           ///< per volume, J/m^3
    double melting_temperature = 0;                   ///< or the solidus
    /** Of a range: its upper end, and the solid fraction within, which falls to zero
     * there; what is missing to one at the solidus freezes at the solidus. */
    std::optional<double> liquidus;
    Property solid_fraction;
    /** Temperatures at which a property bends or jumps. */
    std::vector<double> kinks;

    /** Of a material with curves. @throws InputError for unequal densities, where liquid
     * would move. */
    static VaryingMaterial of(const Material &material);
  };

  /**
   * Freezing (or melting) of a half space x > 0 from a wall held at a temperature, with
   * properties that depend on temperature: everything depends on eta = x/sqrt(t). With
   * phi = k T', f the solid fraction (1, 0, or of the range), C the capacity and L the
   * latent heat per volume, psi = phi - (eta/2) L f is continuous through all fronts and
   *
   *   d eta/dT = k/phi,   d psi/dT = -(eta/2) C - (L f/2) k/phi,
   *
   * in a mixture k = f k_s + (1 - f) k_l and C likewise: no derivative of f is needed.
   * The heat flux at the wall is found by shooting (Fehlberg's order 8 from kink to kink
   * over temperature, the last piece over eta), to about 1e-13.
   */
  class VaryingNeumann : public ExactSolution
  {
  public:
    /**
     * @param wall_temperature  where all is solid (freezing) or liquid (melting)
     * @param far_temperature   where all is liquid (solid), or at the end of the range
     * @throws InputError unless wall and far temperature fit that, or where a property is
     * not positive.
     * @throws NumericalError where no heat flux at the wall gives the far temperature.
     */
    VaryingNeumann(const VaryingMaterial &material, double wall_temperature,
                   double far_temperature);

    /** Where the melting temperature, the solidus or the liquidus is reached. */
    struct Isotherm
    {
      double eta;    ///< x/sqrt(t), m/s^(1/2)
      double behind; ///< k dT/dx sqrt(t) on the side of the wall, W s^(1/2)/m^2
      double beyond; ///< the same on the other side
    };
    Isotherm isotherm(double temperature) const;

    std::string description() const override;
    Symmetry symmetry() const override;

    /** Of the sharp front; with a range the volume of the phase at the wall, per area. */
    double front(double time) const override;
    bool solid_at_origin() const override;

    using ExactSolution::temperature;
    double temperature(double coordinate, double time) const override;

    /** In closed form of the profile: eta H + 2 phi is a primitive of H. Solid at the
     * melting temperature or the solidus counts zero. */
    double heat_content(double lower, double upper, double time) const override;

    using ExactSolution::solid_fraction;
    double solid_fraction(double coordinate, double time) const override;
    using ExactSolution::solid_volume;
    double solid_volume(double lower, double upper, double time) const override;

  private:
    /** eta, psi, the integral of C over temperature, and the volume of the wall's phase.
     */
    using State = std::array<double, 4>;

    /** Between two temperatures all properties are smooth. */
    struct Piece
    {
      double start, end;
      int solid; ///< 1 solid, 0 liquid, -1 a mixture
    };

    struct Node
    {
      double temperature;
      State state;
      std::size_t piece; ///< that begins or goes on here
    };

    double fraction(const Piece &piece, double temperature) const;
    double conductivity(const Piece &piece, double temperature) const;
    double capacity(const Piece &piece, double temperature) const;
    double flux(const Piece &piece, double temperature, const State &state) const;

    /** The solid fraction far away. */
    double far_fraction() const
    {
      return sign > 0 ? 0 : 1;
    }

    void check() const;
    void find_pieces();
    double find_wall_flux();

    /** d/dT of a state. */
    State over_temperature(const Piece &piece, double temperature,
                           const State &state) const;
    /** d/d eta of a state with the temperature in the place of eta. */
    State over_eta(const Piece &piece, double eta, const State &state) const;

    /** From the wall outwards; by how much the temperature far away misses the wanted one
     * in the direction away from the wall's, over the difference of both. */
    double shoot(double wall_flux);

    /** To a temperature of the piece; the temperature reached where the flux ends before.
     */
    double cross(std::size_t piece, double end, double wall_flux, State &state);

    /** Over eta until nothing changes; the temperature there. */
    double run_out(std::size_t piece, double temperature, double wall_flux,
                   const State &state);

    /** The state at x/sqrt(t), eta included. */
    Node at(double eta) const;

    VaryingMaterial material;
    double wall, far;
    double sign; ///< of dT/dx
    std::vector<Piece> pieces;
    std::vector<Node> nodes;
    double last_eta = 0;            ///< beyond it the far temperature
    bool ends_at_front = false;     ///< the far phase stays at the melting temperature
    double sensible_at_melting = 0; ///< the integral of C up to the melting temperature
  };
} // namespace meltfront::cases

#endif
