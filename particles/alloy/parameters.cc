#include <cases/error.h>
#include <cases/scene.h>
#include <particles/alloy/parameters.h>

#include <fmt/format.h>

namespace meltfront::particles
{
  namespace
  {
    const std::vector<std::string> mean_names{"integral", "arithmetic", "harmonic"};

    int resolve_dimension(const std::string &method, const cases::Scene &scene,
                          long wanted)
    {
      if(scene.domain.shape != cases::DomainShape::slab
         && scene.domain.shape != cases::DomainShape::box
         && scene.domain.shape != cases::DomainShape::ball)
        throw cases::Refusal(
            fmt::format("{} simulates slabs, boxes and balls only", method));
      if(scene.domain.shape == cases::DomainShape::slab)
        return wanted > 0 ? static_cast<int>(wanted) : 1;
      if(wanted > 0 && wanted != scene.domain.dimension)
        throw cases::Refusal(fmt::format(
            "{} simulates a box or a ball of {} dimensions in these, not in {}", method,
            scene.domain.dimension, wanted));
      return scene.domain.dimension;
    }

    cases::OptionDeclaration word(const std::string &key, const std::string &value,
                                  const std::string &description,
                                  const std::vector<std::string> &choices)
    {
      return {key, "", value, description, 0, 0, choices};
    }
  } // namespace

  std::vector<cases::OptionDeclaration> mixture_options()
  {
    return {
        {"dimension", "1", 0L, "Dimension in which a slab is simulated; 0: the lowest.",
         0, 3},
        word("kernel", "cubic_spline", "Shape of the smoothing kernel.", kernel_names()),
        {"smoothing", "1", 1.0, "Smoothing length over particle spacing.", 0.5, 4},
        word("layout", "cell",
             "Where the outermost particles are: half a spacing inside, or on the edge.",
             {"cell", "edge"}),
        {"moment_correction", "", true,
         "Divide the kernel's gradient by its second moment, so that the Laplacian of a "
         "quadratic is exact."},
        word("conductivity", "integral",
             "Conductivity between two particles: its mean over the temperatures between "
             "them in equilibrium, which holds at sharp fronts as in a mush, or the "
             "arithmetic or harmonic mean of both.",
             mean_names),
        word("time_scheme", "rkl2",
             "Explicit Euler steps, or Runge-Kutta-Legendre super steps of second order.",
             {"euler", "rkl2"}),
        {"stages", "1", 8L, "Most stages of a super step.", 3, 64},
        {"step_factor", "1", 1.0,
         "Time step over the largest that keeps the maximum principle. More than 1 is "
         "refused.",
         1e-6, 1e6},
        {"jitter", "1", 0.0,
         "Random displacement of each particle, in particle spacings and per direction.",
         0, 0.4},
    };
  }

  MixtureParameters resolve_mixture_parameters(const cases::Scene &scene,
                                               const cases::Resolution &resolution)
  {
    const cases::Options &options = resolution.options;
    MixtureParameters result{};
    SphParameters &p = result.sph;
    p.dimension
        = resolve_dimension("sph-mixture", scene, options.get_integer("dimension"));
    p.kernel = kernel_shape(options.get_string("kernel"));
    p.smoothing = options.get_double("smoothing");
    p.layout = options.get_string("layout") == "edge" ? LatticeLayout::on_edge
                                                      : LatticeLayout::cell_centred;
    p.moment_correction = options.get_bool("moment_correction");
    p.front = FrontRule::partner;
    p.time_scheme = options.get_string("time_scheme") == "euler" ? TimeScheme::euler
                                                                 : TimeScheme::rkl2;
    p.stages = static_cast<int>(options.get_integer("stages"));
    p.step_factor = options.get_double("step_factor");
    p.jitter = options.get_double("jitter");
    p.seed = resolution.seed;
    p.threads = resolution.threads;
    p.n = resolution.n;
    const std::string &mean = options.get_string("conductivity");
    result.mean = mean == "arithmetic" ? MeanConductivity::arithmetic
                  : mean == "harmonic" ? MeanConductivity::harmonic
                                       : MeanConductivity::integral;
    return result;
  }
} // namespace meltfront::particles
