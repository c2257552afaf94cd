#include <cases/error.h>
#include <particles/greenspan/motion/pair_force.h>

#include <fmt/format.h>

#include <cmath>

namespace meltfront::particles::greenspan
{
  namespace
  {
    /** The potential that vanishes at infinity. */
    double free_potential(const PairForce &force, double r)
    {
      const double a = force.repulsion_exponent - 1, b = force.attraction_exponent - 1;
      return force.repulsion / a * std::pow(r, -a)
             - force.attraction / b * std::pow(r, -b) + force.shift() * r;
    }
  } // namespace

  PairForce PairForce::triangle()
  {
    return {};
  }

  PairForce PairForce::rectangle()
  {
    PairForce force;
    force.attraction = 2540;
    force.repulsion = 2940;
    force.attraction_exponent = 7;
    force.repulsion_exponent = 10;
    return force;
  }

  void PairForce::validate() const
  {
    if(!(attraction > 0 && std::isfinite(attraction) && repulsion > 0
         && std::isfinite(repulsion)))
      throw cases::InputError(
          fmt::format("attraction {} and repulsion {} of a pair of particles must be "
                      "positive and finite",
                      attraction, repulsion));
    if(!(attraction_exponent > 1 && repulsion_exponent > attraction_exponent
         && repulsion_exponent <= 40))
      throw cases::InputError(fmt::format(
          "exponents of attraction {} and repulsion {} of a pair of particles "
          "must rise from above 1 to 40 at most",
          attraction_exponent, repulsion_exponent));
    if(!(cutoff > equilibrium_distance() && std::isfinite(cutoff)))
      throw cases::InputError(
          fmt::format("the cutoff {} of the pair force must lie beyond the equilibrium "
                      "distance {:.6g}",
                      cutoff, equilibrium_distance()));
  }

  double PairForce::shift() const
  {
    return shifted ? repulsion * std::pow(cutoff, -repulsion_exponent)
                         - attraction * std::pow(cutoff, -attraction_exponent)
                   : 0;
  }

  double PairForce::magnitude(double r) const
  {
    return repulsion * std::pow(r, -repulsion_exponent)
           - attraction * std::pow(r, -attraction_exponent) - shift();
  }

  double PairForce::potential(double r) const
  {
    return r <= cutoff ? free_potential(*this, r) - free_potential(*this, cutoff) : 0;
  }

  double PairForce::equilibrium_distance() const
  {
    const double difference = repulsion_exponent - attraction_exponent;
    const double unshifted = std::pow(repulsion / attraction, 1 / difference);
    if(!shifted)
      return unshifted;
    // From there to where it draws hardest the force falls.
    constexpr int halvings = 60;
    double below = unshifted,
           above = unshifted
                   * std::pow(repulsion_exponent / attraction_exponent, 1 / difference);
    for(int halving = 0; halving < halvings; ++halving)
    {
      const double middle = (below + above) / 2;
      (magnitude(middle) > 0 ? below : above) = middle;
    }
    return (below + above) / 2;
  }

  double PairForce::stiffness() const
  {
    const double r = equilibrium_distance();
    return repulsion_exponent * repulsion * std::pow(r, -repulsion_exponent - 1)
           - attraction_exponent * attraction * std::pow(r, -attraction_exponent - 1);
  }

  double PairForce::bond_work() const
  {
    return -potential(equilibrium_distance());
  }

  double PairForce::stable_time_step(int dimension) const
  {
    return 2 / std::sqrt((dimension == 3 ? 8 : 6) * stiffness());
  }
} // namespace meltfront::particles::greenspan
