#include <particles/relaxation/relax_nodes.h>

namespace meltfront::particles
{
  CoordinateBox coordinate_box(const cases::Domain &domain)
  {
    return {domain.dimension, domain.lower, domain.upper};
  }

  Descent relax_inner_nodes(NodeSet &nodes, const cases::Domain &domain,
                            LennardJonesRelaxation parameters, double length_over_spacing)
  {
    ParticleStorage moving{domain.dimension, {}}, fixed = moving;
    for(std::size_t i = 0; i < nodes.size(); ++i)
      if(nodes.sides[i] == 0)
        moving.add(nodes.point(i));
      else
        fixed.add(nodes.point(i));
    parameters.potential.length = length_over_spacing * nodes.spacing;
    const Descent descent
        = relax_by_lennard_jones(moving, fixed, coordinate_box(domain), parameters);
    for(std::size_t m = 0; m < nodes.inner.size(); ++m)
      for(int d = 0; d < domain.dimension; ++d)
        nodes.positions.position[d][nodes.inner[m]] = moving.position[d][m];
    return descent;
  }

  void relax_inner_nodes(NodeSet &nodes, const cases::Scene &scene)
  {
    relax_inner_nodes(nodes, scene.domain, {}, 1);
  }
} // namespace meltfront::particles
