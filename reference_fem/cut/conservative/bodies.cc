#include <reference_fem/cut/conservative/bodies.h>

#include <numeric>

namespace meltfront::reference_fem::cut::conservative
{
  namespace
  {
    unsigned int root(std::vector<unsigned int> &parent, unsigned int node)
    {
      while(parent[node] != node)
        node = parent[node] = parent[parent[node]];
      return node;
    }
  } // namespace

  std::vector<Body> bodies(const TriangleMesh &mesh, const Front &front,
                           const Values &level_set)
  {
    std::vector<unsigned int> parent(mesh.nodes.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto solid = [&](unsigned int node) { return level_set[node] < 0; };
    for(const Triangle &triangle : mesh.triangles)
      for(std::size_t i = 0; i < 3 && !triangle.part.empty(); ++i)
      {
        const unsigned int a = triangle.nodes[i], b = triangle.nodes[(i + 1) % 3];
        if(solid(a) == solid(b))
          parent[root(parent, a)] = root(parent, b);
      }
    std::vector<int> number(mesh.nodes.size(), -1);
    std::vector<Body> result;
    std::vector<char> listed(mesh.nodes.size(), false);
    for(unsigned int t = 0; t < mesh.triangles.size(); ++t)
    {
      std::array<bool, 2> counted{};
      for(const unsigned int node : mesh.triangles[t].nodes)
      {
        if(mesh.triangles[t].part.empty())
          continue;
        const Phase phase = solid(node) ? Phase::solid : Phase::liquid;
        int &body = number[root(parent, node)];
        if(body < 0)
        {
          body = static_cast<int>(result.size());
          result.push_back({phase, {}});
        }
        Body &of_node = result[static_cast<std::size_t>(body)];
        if(!listed[node])
          of_node.nodes.push_back(node);
        listed[node] = true;
        // The nodes of one phase in a triangle belong to one body.
        if(!counted[index(phase)])
          of_node.area += front.part(t, phase).area();
        counted[index(phase)] = true;
      }
    }
    return result;
  }

  void turn(const TriangleMesh &mesh, const Front &front, const Body &body,
            double latent_heat, FrontState &state)
  {
    const Phase other = body.phase == Phase::solid ? Phase::liquid : Phase::solid;
    const double sign = body.phase == Phase::solid ? -1 : 1;
    std::vector<char> of_body(mesh.nodes.size(), false), touched = of_body,
                                                         shared = of_body;
    for(const unsigned int node : body.nodes)
      of_body[node] = true;
    Values &to = state.heat[index(other)], &from = state.heat[index(body.phase)];
    for(unsigned int t = 0; t < mesh.triangles.size(); ++t)
    {
      const Triangle &triangle = mesh.triangles[t];
      const Polygon &part = front.part(t, body.phase);
      bool in_body = false;
      for(const unsigned int node : triangle.nodes)
        in_body = in_body || of_body[node];
      for(const unsigned int node : triangle.nodes)
        (in_body ? touched : shared)[node]
            = (in_body ? touched : shared)[node] || in_body || !part.empty();
      if(in_body)
        integrate(part,
                  [&](const Point &point, double weight)
                  {
                    for(int i = 0; i < 3; ++i)
                      to[triangle.nodes[static_cast<std::size_t>(i)]]
                          += sign * latent_heat * weight * triangle.hat(i, point);
                  });
    }
    // Hats that reach into another body of the phase keep what they hold.
    for(std::size_t node = 0; node < touched.size(); ++node)
      if(touched[node] && !shared[node])
      {
        to[node] += from[node] - latent_heat * state.debt[node];
        from[node] = state.debt[node] = 0;
      }
    for(const unsigned int node : body.nodes)
      state.level_set[node] *= -1;
  }
} // namespace meltfront::reference_fem::cut::conservative
