#include <verification/app/tests/claims/tolerances.h>

#include <map>

namespace meltfront::verification::claims
{
  namespace
  {
    bool published(const std::string &method)
    {
      return method.ends_with("-2005");
    }

    /** Fewer steps in space, and no more cells around than what is round needs. */
    void adapt_fitted(const std::string &form, Trial &trial)
    {
      const int dimension = trial.scene.domain.dimension;
      const bool round = trial.scene.domain.round();
      trial.n = form == "along a line" ? 16 : 10;
      if(form == "along a line" || dimension < 3)
        return;
      trial.n = round ? 14 : 3;
      trial.options = {{"steps", "40"}};
      if(round)
        trial.options.insert(trial.options.end(),
                             {{"cells_around", "4"}, {"degree", "3"}});
    }
  } // namespace

  void adapt(const std::string &method, const std::string &form, Trial &trial)
  {
    using cases::DomainShape;
    const DomainShape shape = trial.scene.domain.shape;
    const int dimension = trial.scene.domain.dimension;
    if(method == "fem-fitted")
      adapt_fitted(form, trial);
    if(method == "fem-cut")
    {
      // A layer on a wall is followed from three cells on.
      const bool begins = !trial.scene.sources.empty() || !trial.scene.initial.front;
      trial.n = begins ? 40 : trial.scene.domain.round() ? 24 : 16;
    }
    if(method == "rkpm-tracked" && form == "along a line" && dimension > 1)
      trial.n = 28;
    if(method == "sph-mixture" && shape == DomainShape::ball && dimension == 3)
      trial.n = 20;
    if(form == "in the plane")
    {
      // A layer on a wall is followed from three nodes on.
      const bool begins = !trial.scene.initial.front;
      trial.n = trial.scene.material.gibbs_thomson_coefficient != 0 ? 24
                : !trial.scene.sources.empty()                      ? 28
                : begins                                            ? 40
                                                                    : 18;
    }
    if(form == "on several ranks")
    {
      trial.n = dimension == 2 ? 48 : 24;
      trial.options.emplace_back("engine", "distributed");
    }
    if(method == "fem-enthalpy" && shape == DomainShape::axisymmetric)
      trial.n = 36;
    if(method == "fem-enthalpy" && form == "where liquid is displaced")
      trial.n = 80; // little liquid is left at the end, and its mapping is of first order
    if(form == "where liquid flows")
    {
      if(shape == DomainShape::slab)
        trial.options.emplace_back("dimension", "2");
      else if(dimension == 2 || trial.scene.domain.round())
        trial.n = dimension == 2 ? 40 : 24; // each has a front, smeared over a spacing
    }
    if(method == "fem-enthalpy" && shape == DomainShape::ball)
      trial.n = !trial.scene.sources.empty() ? 64
                : dimension == 2             ? 32
                                             : 16; // a power of two
    if(published(method))
      trial.n += 1 - trial.n % 2; // particles on both walls: an even number of spacings
    if(method == "sph-2005" && trial.scene.inclusion)
      trial.options = {{"step_factor", "0.04"}};
    else if(method == "sph-2005" && dimension > 1)
      trial.options = {{"step_factor", "0.1"}};
  }

  Tolerance tolerance_of(const std::string &method, const cases::Scene &scene)
  {
    static const std::map<std::string, Tolerance> list{
        // Enthalpies of particles: the front's place within a spacing is smeared.
        {"sph", {0.02, 0.005}},
        {"sph-mixture", {0.012, 0.006}},
        {"sph-two-population", {0.01, 0.003}},
        // Of first order, as published.
        {"sph-2005", {0.03, 0.0142}},
        {"sph-two-population-2005", {0.045, 0.0125}},
        {"fem-enthalpy", {0.012, 0.006}},
        {"rkpm-tracked", {0.005, 0.0025}},
        {"fem-fitted", {1e-4, 1e-5}},
        {"fem-cut", {0.01, 0.006}},
        // Particles move in steps of 1e-4; a bar's front wanders by several spacings.
        {"greenspan", {0.02, 0.02}}};
    const auto found = list.find(method);
    if(found
       == list.end()) // second order or better, without a front; regions carried along
      return {0.005, 0.005};
    if(method == "rkpm-tracked" && scene.domain.dimension > 1)
      return {0.024, 0.01};
    if(method == "greenspan" && scene.conducts_heat())
      return {0.2, 0.06};
    return found->second;
  }
} // namespace meltfront::verification::claims
