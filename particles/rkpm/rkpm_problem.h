#ifndef meltfront_particles_rkpm_rkpm_problem_h
#define meltfront_particles_rkpm_rkpm_problem_h

#include <particles/rkpm/collocation_rows.h>
#include <particles/rkpm/rkpm_parameters.h>
#include <particles/scattered/linear_problem.h>
#include <particles/scattered/node_set.h>

#include <array>
#include <string>
#include <vector>

namespace meltfront::particles::rkpm
{
  /**
   * Heat conduction collocated at the nodes: the equation at inner nodes, the walls'
   * conditions at nodes on walls, and at nodes on the surface of an inclusion
   *
   *   n . (k_outside grad T|outside - k_inside grad T|inside) = 0
   *
   * with gradients from neighbours of one side only. Nodes of either side have their
   * supports on that side, the surface included.
   */
  class RkpmProblem
  {
  public:
    /**
     * @param scene, nodes, parameters outlive the problem
     * @param method its name, for messages
     * @throws cases::Refusal for a kernel and dilation with a spurious mode, for nodes
     * that determine no polynomial, and for unknowns that an inclusion cannot have.
     */
    RkpmProblem(const cases::Scene &scene, const NodeSet &nodes,
                const RkpmParameters &parameters, const std::string &method, int threads);

    RkpmProblem(const RkpmProblem &) = delete;
    RkpmProblem &operator=(const RkpmProblem &) = delete;

    const LinearProblem &linear() const
    {
      return problem;
    }

    /** What the report prints of supports, stability and conditioning. */
    std::vector<cases::Parameter> describe() const;

    /** Mean dilation of the inner nodes (m). */
    double mean_dilation() const;

    /** Entries of all weights. */
    long work() const;

    std::vector<cases::EffectCost> effect_costs(const cases::EffectSet &effects) const;

  private:
    /** Weights at some of the nodes, from these nodes only. */
    struct Part
    {
      ParticleStorage positions;
      std::vector<std::uint32_t> nodes;
      std::vector<std::int32_t> row_of; ///< of each node of all; -1: not in this part
      ReproducingWeights weights;
    };

    Part make_part(Region excluded) const;
    double checked_symbol() const;
    void assemble();
    void add_equation(std::size_t node);
    void add_wall(std::size_t node, const WallCondition &condition);
    void add_surface(std::size_t node);
    void collect(const Part &part, std::size_t node, const RowCoefficients &coefficients);
    void finish_row(CompressedRows &rows);
    void evaluate_sources(const LinearStep &step, std::span<double> source);
    const Part &part_of(std::size_t node) const;
    double conductivity_of(std::size_t node) const;
    bool on_surface(std::size_t node) const;
    cases::Position surface_normal(std::size_t node) const;
    std::vector<double> sampled_condition_numbers() const;

    const cases::Scene &scene;
    GivenValues given;
    const NodeSet &nodes;
    const RkpmParameters &parameters;
    std::string method;
    int threads;
    std::vector<Part>
        parts; ///< one, or what is outside and what is inside of an inclusion
    std::vector<std::uint32_t> wall_nodes;
    std::vector<WallCondition> walls; ///< of the wall_nodes
    double symbol = 0;                ///< least ratio of the symbol
    LinearProblem problem;
    std::vector<std::uint32_t> row_columns, scratch;
    std::vector<double> row_values;
    double inclusion_seconds = 0, release_seconds = 0, wall_seconds = 0;
    long evaluations = 0;
  };
} // namespace meltfront::particles::rkpm

#endif
