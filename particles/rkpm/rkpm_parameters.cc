#include <cases/error.h>
#include <particles/rkpm/rkpm_parameters.h>
#include <particles/rkpm/stability_symbol.h>
#include <particles/scattered/linear_problem.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::rkpm
{
  namespace
  {
    /** The kernels that a user may name: those of all dimensions. */
    cases::Words<KernelShape> shapes()
    {
      cases::Words<KernelShape> words;
      for(const std::string &name : kernel_names())
        if(!name.ends_with("_line"))
          words.emplace_back(name, kernel_shape(name));
      return words;
    }

    /** Dilation over spacing that n nearest neighbours have inside a cubic lattice, the
     * node itself counted: the distance of the next one. */
    double lattice_alpha(int dimension, int neighbours)
    {
      constexpr int reach = 8;
      std::vector<int> squared;
      const auto range = [dimension](int d) { return d < dimension ? reach : 0; };
      for(int i = -range(0); i <= range(0); ++i)
        for(int j = -range(1); j <= range(1); ++j)
          for(int k = -range(2); k <= range(2); ++k)
            squared.push_back(i * i + j * j + k * k);
      std::ranges::sort(squared);
      const std::size_t next
          = std::min(static_cast<std::size_t>(neighbours), squared.size() - 1);
      return std::sqrt(double(squared[next]));
    }

    /** Twice as many as basis functions, or the most below that without a spurious mode;
     * twice as many again where all have one. */
    int default_neighbours(const MomentSettings &moments)
    {
      const int functions = MonomialBasis(moments.dimension, moments.order).size();
      for(int n = 2 * functions; n > functions; --n)
        if(stability_ratio(moments, lattice_alpha(moments.dimension, n))
           >= least_stable_ratio)
          return n;
      return 2 * functions;
    }

    /** A support wide enough for a boundary, that a spurious mode does not yet enter. */
    double default_alpha(int order)
    {
      return order + 0.5;
    }
  } // namespace

  const std::vector<RkpmPolicy> &rkpm_policies()
  {
    static const std::vector<RkpmPolicy> policies{
        {"rkpm-point-collocation",
         "Reproducing kernel collocation whose kernel moves with the point and is "
         "differentiated.",
         Variant::point_collocation},
        {"rkpm-fixed-point",
         "Reproducing kernel collocation whose kernel is fixed at each node: derivatives "
         "are those of a weighted polynomial fit.",
         Variant::fixed_point},
        {"rkpm-moving",
         "Moving least squares: polynomials of the place itself, the kernel "
         "differentiated.",
         Variant::moving},
        {"rkpm-multiple-fixed",
         "Reproducing kernel collocation in which each neighbour has its own dilation.",
         Variant::multiple_fixed},
        {"rkpm-derivative-free",
         "Reproducing kernel collocation whose derivatives come from moment conditions, "
         "the kernel never differentiated.",
         Variant::derivative_free}};
    return policies;
  }

  void RkpmOptions::bind(cases::OptionBinder &options)
  {
    options.add("kernel", kernel, "Shape of the kernel.", shapes());
    options.add("basis_order", basis_order,
                "Order of the polynomials that are reproduced.", 2, highest_order);
    options.add("support", support,
                "The nearest neighbours, or all nodes within a fixed dilation.",
                {{"nearest", SupportRule::nearest_neighbours},
                 {"dilation", SupportRule::fixed_dilation}});
    options.add("neighbours", neighbours,
                "Neighbours of a nearest support, the node itself counted; 0: twice the "
                "number of basis functions, or fewer where that has a spurious mode.",
                0, 1000);
    options.add("dilation", dilation,
                "Radius of a fixed support over the spacing; 0: basis_order + 0.5.", 0,
                20);
    options.add("stability", refuse_unstable,
                "Refuse kernels and dilations with a spurious mode on the infinite "
                "lattice, or only report it.",
                {{"refuse", true}, {"report", false}});
    options.add("unknowns", unknowns,
                "Temperatures at the nodes, or the coefficients that they are "
                "reconstructed from.",
                {{"nodal", Unknowns::nodal}, {"reconstructed", Unknowns::reconstructed}});
    options.add("flux_row", flux_row_as_printed,
                "A wall's flux prescribes the normal derivative; printed: the second "
                "derivative, which is singular (Erickson et al. 2016, equation 2.33).",
                {{"derivative", false}, {"printed", true}});
    options.add("arrangement", arrangement, "How the inner nodes are arranged.",
                cases::in_order<NodeArrangement>(arrangement_names()));
    options.add(
        "jitter", jitter,
        "Largest displacement of jittered nodes over the spacing, in each direction.", 0,
        0.5);
    if(policy.variant == Variant::fixed_point || policy.variant == Variant::moving)
      options.add("origin", origin,
                  "Origin of the monomials: the point itself, or that of space, as "
                  "printed.",
                  {{"point", Origin::point}, {"absolute", Origin::absolute}});
    linear.bind(options);
  }

  RkpmParameters read_parameters(const RkpmPolicy &policy, const cases::Options &given,
                                 int dimension)
  {
    const auto options = cases::read_options(RkpmOptions{.policy = policy}, given);
    RkpmParameters result;
    MomentSettings &moments = result.moments;
    moments.variant = policy.variant;
    moments.kernel = options.kernel;
    moments.dimension = dimension;
    moments.order = options.basis_order;
    moments.origin = options.origin;
    SupportSettings &supports = result.supports;
    supports.rule = options.support;
    supports.neighbours = options.neighbours;
    if(supports.rule == SupportRule::nearest_neighbours)
    {
      if(supports.neighbours == 0)
        supports.neighbours = default_neighbours(moments);
      supports.alpha = lattice_alpha(dimension, supports.neighbours);
    }
    else
      supports.alpha
          = options.dilation == 0 ? default_alpha(moments.order) : options.dilation;
    result.unknowns = options.unknowns;
    result.refuse_unstable = options.refuse_unstable;
    result.flux_row_as_printed = options.flux_row_as_printed;
    result.jitter = options.jitter;
    result.arrangement = options.arrangement;
    return result;
  }
} // namespace meltfront::particles::rkpm
