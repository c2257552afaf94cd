#include <cases/error.h>
#include <cases/scene.h>
#include <particles/alloy/options.h>

#include <fmt/format.h>

namespace meltfront::particles
{
  namespace
  {
    int resolve_dimension(const std::string &method, const cases::Scene &scene,
                          int wanted, int of_slab)
    {
      if(scene.domain.shape == cases::DomainShape::shell)
        throw cases::Refusal(fmt::format(
            "{} simulates slabs, boxes, balls and what an outline bounds", method));
      if(scene.domain.shape == cases::DomainShape::slab)
        return wanted > 0 ? wanted : of_slab;
      if(wanted > 0 && wanted != scene.domain.dimension)
        throw cases::Refusal(fmt::format(
            "{} simulates a box or a ball of {} dimensions in these, not in {}", method,
            scene.domain.dimension, wanted));
      return scene.domain.dimension;
    }
  } // namespace

  void bind_alloy_options(SphParameters &p, cases::OptionBinder &options)
  {
    options.add("dimension", p.dimension,
                "Dimension in which a slab is simulated; 0: the lowest (the paper's: "
                "2).",
                0, 3);
    options.add("kernel", p.kernel, "Shape of the smoothing kernel.",
                smoothing_kernels());
    options.add("smoothing_length", p.smoothing_length,
                "Smoothing length over particle spacing.", 0.5, 4);
    options.add("layout", p.layout,
                "Where the outermost particles are: half a spacing inside, or on the "
                "edge.",
                layouts());
    options.add("moment_correction", p.moment_correction,
                "Divide the kernel's gradient by its second moment, so that the "
                "Laplacian of a quadratic is exact.");
    options.add("jitter", p.jitter,
                "Random displacement of each particle, in particle spacings and per "
                "direction.",
                0, 0.4);
  }

  void resolve_alloy_options(SphParameters &p, const std::string &method,
                             const cases::Scene &scene,
                             const cases::Resolution &resolution, int of_slab)
  {
    p.seed = resolution.seed;
    p.threads = resolution.threads;
    p.n = resolution.n;
    p.dimension = resolve_dimension(method, scene, p.dimension, of_slab);
  }

  cases::Capabilities
  alloy_capabilities(std::vector<cases::Effect> effects,
                     std::vector<cases::BoundaryKind> round_walls,
                     std::vector<cases::BoundaryKind> outlines,
                     std::vector<cases::FrontOrigin> of_pure_substances, int most_threads)
  {
    using cases::BoundaryKind, cases::DomainShape;
    std::vector<cases::BoundaryKind> walls = round_walls;
    walls.push_back(BoundaryKind::periodic);
    return {.form = {},
            .problems = {cases::ProblemKind::stefan},
            .effects = std::move(effects),
            .shapes = {{DomainShape::slab, {1}, walls},
                       {DomainShape::box, {2, 3}, walls},
                       {DomainShape::ball, {2, 3}, std::move(round_walls)},
                       {DomainShape::outline, {2}, std::move(outlines)}},
            .front_origins = std::move(of_pure_substances),
            .most_threads = most_threads};
  }
} // namespace meltfront::particles
