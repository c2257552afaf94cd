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
    std::vector<std::string> shapes()
    {
      std::vector<std::string> names = kernel_names();
      std::erase_if(names,
                    [](const std::string &name) { return name.ends_with("_line"); });
      return names;
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

  std::vector<cases::OptionDeclaration> rkpm_options(const RkpmPolicy &policy)
  {
    std::vector<cases::OptionDeclaration> options{
        {"kernel", "", std::string("wendland_c4"), "Shape of the kernel.", 0, 0,
         shapes()},
        {"basis_order", "1", 2L, "Order of the polynomials that are reproduced.", 2,
         highest_order},
        {"support", "", std::string("nearest"),
         "The nearest neighbours, or all nodes within a fixed dilation.", 0, 0,
         std::vector<std::string>{"nearest", "dilation"}},
        {"neighbours", "1", 0L,
         "Neighbours of a nearest support, the node itself counted; 0: twice the number "
         "of basis functions, or fewer where that has a spurious mode.",
         0, 1000},
        {"dilation", "1", 0.,
         "Radius of a fixed support over the spacing; 0: basis_order + 0.5.", 0, 20},
        {"stability", "", std::string("refuse"),
         "Refuse kernels and dilations with a spurious mode on the infinite lattice, or "
         "only report it.",
         0, 0, std::vector<std::string>{"refuse", "report"}},
        {"unknowns", "", std::string("nodal"),
         "Temperatures at the nodes, or the coefficients that they are reconstructed "
         "from.",
         0, 0, std::vector<std::string>{"nodal", "reconstructed"}},
        {"flux_row", "", std::string("derivative"),
         "A wall's flux prescribes the normal derivative; printed: the second "
         "derivative, "
         "which is singular (Erickson et al. 2016, equation 2.33).",
         0, 0, std::vector<std::string>{"derivative", "printed"}},
        {"arrangement", "", std::string("lattice"), "How the inner nodes are arranged.",
         0, 0, arrangement_names()},
        {"jitter", "1", 0.2,
         "Largest displacement of jittered nodes over the spacing, in each direction.", 0,
         0.5}};
    if(policy.variant == Variant::fixed_point || policy.variant == Variant::moving)
      options.push_back(
          {"origin", "", std::string("point"),
           "Origin of the monomials: the point itself, or that of space, as "
           "printed.",
           0, 0, std::vector<std::string>{"point", "absolute"}});
    for(const cases::OptionDeclaration &option : linear_options())
      options.push_back(option);
    return options;
  }

  RkpmParameters read_parameters(const RkpmPolicy &policy, const cases::Options &options,
                                 int dimension)
  {
    RkpmParameters result;
    MomentSettings &moments = result.moments;
    moments.variant = policy.variant;
    moments.kernel = kernel_shape(options.get_string("kernel"));
    moments.dimension = dimension;
    moments.order = static_cast<int>(options.get_integer("basis_order"));
    if(policy.variant == Variant::fixed_point || policy.variant == Variant::moving)
      moments.origin
          = options.get_string("origin") == "point" ? Origin::point : Origin::absolute;
    SupportSettings &supports = result.supports;
    supports.rule = options.get_string("support") == "nearest"
                        ? SupportRule::nearest_neighbours
                        : SupportRule::fixed_dilation;
    supports.neighbours = static_cast<int>(options.get_integer("neighbours"));
    if(supports.rule == SupportRule::nearest_neighbours)
    {
      if(supports.neighbours == 0)
        supports.neighbours = default_neighbours(moments);
      supports.alpha = lattice_alpha(dimension, supports.neighbours);
    }
    else
    {
      supports.alpha = options.get_double("dilation");
      if(supports.alpha == 0)
        supports.alpha = default_alpha(moments.order);
    }
    result.unknowns = options.get_string("unknowns") == "nodal" ? Unknowns::nodal
                                                                : Unknowns::reconstructed;
    result.refuse_unstable = options.get_string("stability") == "refuse";
    result.flux_row_as_printed = options.get_string("flux_row") == "printed";
    result.jitter = options.get_double("jitter");
    const std::string &arrangement = options.get_string("arrangement");
    result.arrangement
        = static_cast<NodeArrangement>(std::ranges::find(arrangement_names(), arrangement)
                                       - arrangement_names().begin());
    return result;
  }
} // namespace meltfront::particles::rkpm
