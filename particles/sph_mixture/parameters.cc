#include <cases/error.h>
#include <cases/scene.h>
#include <particles/alloy/options.h>
#include <particles/sph_mixture/parameters.h>

namespace meltfront::particles
{
  MixtureParameters::MixtureParameters()
  {
    sph.time_scheme = TimeScheme::rkl2;
  }

  void MixtureParameters::bind(cases::OptionBinder &options)
  {
    bind_alloy_options(sph, options);
    options.add("conductivity", mean,
                "Conductivity between two particles: its mean over the temperatures "
                "between them in equilibrium, which holds at sharp fronts as in a mush, "
                "or the arithmetic or harmonic mean of both.",
                {{"integral", MeanConductivity::integral},
                 {"arithmetic", MeanConductivity::arithmetic},
                 {"harmonic", MeanConductivity::harmonic}});
    options.add("time_scheme", sph.time_scheme,
                "Explicit Euler steps, Runge-Kutta-Legendre super steps of second order, "
                "or implicit steps of first or second order.",
                cases::in_order<TimeScheme>(time_scheme_names()));
    options.add("stages", sph.stages, "Most stages of a super step.", 3, 64);
    options.add(
        "step_factor", sph.step_factor,
        "Time step over the largest that keeps the maximum principle. More than 1 "
        "is for implicit steps only.",
        1e-6, 1e6);
    bind_step_limit(sph, options);
    options.add("step_error", sph.step_error,
                "Wanted relative error of each implicit step, which sets its length; 0: "
                "steps of equal length by step_factor.",
                0, 1);
  }

  MixtureParameters resolve_mixture_parameters(const cases::Scene &scene,
                                               const cases::Resolution &resolution)
  {
    auto result = cases::read_options(MixtureParameters(), resolution.options);
    SphParameters &p = result.sph;
    resolve_alloy_options(p, "sph-mixture", scene, resolution, 1);
    if(p.step_error > 0 && !is_implicit(p.time_scheme))
      throw cases::Refusal("sph-mixture chooses steps by a wanted error (step_error) for "
                           "the implicit schemes backward-euler and crank-nicolson only");
    return result;
  }
} // namespace meltfront::particles
