#ifndef meltfront_reference_fem_enthalpy_front_conduction_h
#define meltfront_reference_fem_enthalpy_front_conduction_h

#include <cases/material.h>
#include <reference_fem/enthalpy/mesh.h>

#include <vector>

namespace meltfront::reference_fem
{
  /**
   * Conductances that take the front at its place within the melting nodes (the enthalpy
   * method of Tacke 1985 on any mesh).
   *
   * A melting node is at T_m, but its front is not at the node: of the cell that it
   * stands for the share p nearest to a neighbour b is in b's phase, so that b sees T_m
   * at 1/2 + p spacings (1/2 + p/2 where the node is on a wall and b is not). Between
   * solid and liquid the front is half way; it gives 2 |u_s| to one side and takes 2 u_l
   * from the other, and the node that is about to change phase bears the difference, so
   * that twice the larger of the two is exchanged. Each is a factor of the pair's
   * conductance, between 2/3 and 2, the same in both rows: the matrix stays a network of
   * positive conductances, with its balance and its maximum principle.
   *
   * Where two nodes' sensible heat exceeds the latent heat, the front is a mere isotherm:
   * the factors tend to one with latent over sensible heat.
   */
  class FrontConduction
  {
  public:
    FrontConduction(const Discretisation &mesh, const cases::Material &material,
                    const std::vector<char> &free);

    /** Take the conductances of a state. @param enthalpy per volume by node (J/m^3) */
    void follow(const std::vector<double> &enthalpy);

    const ConductionMatrix &matrix() const
    {
      return conduction;
    }

  private:
    struct Node
    {
      double u;        ///< Kirchhoff's variable (W/m)
      double molten;   ///< share of the latent heat
      double sensible; ///< |H| without the latent heat (J/m^3)
    };

    double factor(std::size_t a, std::size_t b) const;
    double factor_of_melting(std::size_t melting, std::size_t partner) const;
    bool melts(std::size_t node) const;

    const Discretisation &mesh;
    const std::vector<char> &free;
    double volumetric_latent_heat;
    double solid_diffusivity, liquid_diffusivity;
    std::vector<char> on_wall;
    std::vector<Node> nodes;
    ConductionMatrix conduction;
  };
} // namespace meltfront::reference_fem

#endif
