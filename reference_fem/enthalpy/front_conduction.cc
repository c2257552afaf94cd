#include <reference_fem/enthalpy/front_conduction.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem
{
  FrontConduction::FrontConduction(const Discretisation &mesh,
                                   const cases::Material &material,
                                   const std::vector<char> &free)
    : mesh(mesh)
    , free(free)
    , volumetric_latent_heat(material.solid.density * material.latent_heat)
    , solid_diffusivity(material.solid.diffusivity())
    , liquid_diffusivity(material.liquid.diffusivity())
    , on_wall(mesh.volume.size())
    , nodes(mesh.volume.size())
    , conduction(mesh.conduction)
  {
    for(const std::vector<WallNode> &wall : mesh.walls)
      for(const WallNode &node : wall)
        on_wall[node.node] = 1;
  }

  void FrontConduction::follow(const std::vector<double> &enthalpy)
  {
    for(std::size_t i = 0; i < nodes.size(); ++i)
    {
      const double solid = std::min(enthalpy[i], 0.);
      const double liquid = std::max(enthalpy[i] - volumetric_latent_heat, 0.);
      nodes[i]
          = {solid_diffusivity * solid + liquid_diffusivity * liquid,
             std::clamp(enthalpy[i] / volumetric_latent_heat, 0., 1.), liquid - solid};
    }
    conduction.weigh(mesh.conduction,
                     [this](std::size_t a, std::size_t b) { return factor(a, b); });
  }

  bool FrontConduction::melts(std::size_t node) const
  {
    return free[node] && nodes[node].u == 0;
  }

  double FrontConduction::factor_of_melting(std::size_t melting,
                                            std::size_t partner) const
  {
    const double molten = nodes[melting].molten;
    const double of_partner = nodes[partner].u < 0 ? 1 - molten : molten;
    const double width = on_wall[melting] && !on_wall[partner] ? 0.5 : 1;
    return 1 / (0.5 + of_partner * width);
  }

  double FrontConduction::factor(std::size_t a, std::size_t b) const
  {
    const double u_a = nodes[a].u, u_b = nodes[b].u;
    double whole = 1;
    if(u_a * u_b < 0)
      whole = 2 * std::max(std::abs(u_a), std::abs(u_b)) / std::abs(u_a - u_b);
    else if(u_b != 0 && melts(a))
      whole = factor_of_melting(a, b);
    else if(u_a != 0 && melts(b))
      whole = factor_of_melting(b, a);
    const double sensible = nodes[a].sensible + nodes[b].sensible;
    return 1
           + (whole - 1) * volumetric_latent_heat
                 / std::max(volumetric_latent_heat, sensible);
  }
} // namespace meltfront::reference_fem
