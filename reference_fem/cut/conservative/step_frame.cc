#include <reference_fem/cut/conservative/step_frame.h>

#include <algorithm>

namespace meltfront::reference_fem::cut::conservative
{
  namespace
  {
    /** Spacings from a phase within which it has temperatures: a stage moves the front by
     * one at most. */
    constexpr double active_width = 2;

    /** Spacings from the front within which the level set moves. */
    constexpr double band_width = 3.5;

    /** Of the isotropic smoothing, what is left where two fronts meet halfway: it makes
     * the matrix regular, and carries a thousandth of what one moves more than the other.
     */
    constexpr double share_between_fronts = 0.1;
  } // namespace

  Values Operator::apply(const LocalVector &unknowns) const
  {
    Values result = constant;
    for(const Eigen::Triplet<double> &entry : entries)
      result[static_cast<std::size_t>(entry.row())]
          += entry.value() * unknowns[entry.col()];
    return result;
  }

  void append(const Operator &source, double factor, const std::vector<int> &row_of_node,
              std::vector<Eigen::Triplet<double>> &result)
  {
    for(const Eigen::Triplet<double> &entry : source.entries)
      result.emplace_back(row_of_node[static_cast<std::size_t>(entry.row())], entry.col(),
                          factor * entry.value());
  }

  double sum(const Values &values)
  {
    double result = 0;
    for(const double value : values)
      result += value;
    return result;
  }

  StepFrame::StepFrame(const TriangleMesh &mesh, Values front_at_begin, double factor,
                       double isotropic)
    : level_set(std::move(front_at_begin))
    , front(mesh, level_set)
    , displacement(mesh.nodes.size(), -1)
    , smoothing(mesh.nodes.size())
  {
    number_temperatures(mesh);
    if(std::ranges::any_of(front.cut, [](const CutTriangle &cut) { return cut.crossed; }))
    {
      number_displacements(mesh);
      assemble_smoothing(mesh, factor * mesh.spacing, isotropic);
    }
  }

  void StepFrame::number_temperatures(const TriangleMesh &mesh)
  {
    for(const Phase phase : phases)
    {
      const double sign = phase == Phase::solid ? 1 : -1;
      std::vector<char> &taking_part = active[index(phase)];
      std::vector<int> &number = temperature[index(phase)];
      taking_part.assign(mesh.triangles.size(), false);
      number.assign(mesh.nodes.size(), -1);
      if(!(front.area(phase) > 0))
        continue;
      for(unsigned int t = 0; t < mesh.triangles.size(); ++t)
      {
        const Triangle &triangle = mesh.triangles[t];
        if(triangle.part.empty()
           || std::ranges::none_of(
               triangle.nodes, [&](unsigned int node)
               { return sign * level_set[node] < active_width * mesh.spacing; }))
          continue;
        taking_part[t] = true;
        for(const unsigned int node : triangle.nodes)
          if(number[node] < 0)
            number[node] = unknowns++;
      }
    }
  }

  void StepFrame::number_displacements(const TriangleMesh &mesh)
  {
    for(unsigned int t = 0; t < mesh.triangles.size(); ++t)
    {
      const Triangle &triangle = mesh.triangles[t];
      if(triangle.part.empty()
         || !std::ranges::all_of(
             triangle.nodes, [&](unsigned int node)
             { return std::abs(level_set[node]) < band_width * mesh.spacing; }))
        continue;
      band.push_back(t);
      for(const unsigned int node : triangle.nodes)
        if(displacement[node] < 0)
          displacement[node] = unknowns++;
    }
  }

  void StepFrame::assemble_smoothing(const TriangleMesh &mesh, double factor,
                                     double isotropic)
  {
    // A node of the band is as far from the front, but for what a cut triangle's slope
    // is off by.
    const std::vector<Gradient> normals
        = nearest_normals(mesh, front, 2 * band_width * mesh.spacing);
    for(const unsigned int t : band)
    {
      const Triangle &triangle = mesh.triangles[t];
      const Gradient slope = triangle.gradient(level_set);
      const auto &[a, b, c] = triangle.nodes;
      const bool of_one_front = normals[a] * normals[b] > 0 && normals[b] * normals[c] > 0
                                && normals[c] * normals[a] > 0;
      // Where the distance has a ridge it has no normal: there the term fades.
      const double weight = factor * triangle.area,
                   along = of_one_front ? weight / std::max(1., slope.norm_square()) : 0,
                   across
                   = (of_one_front ? 1 : share_between_fronts) * isotropic * weight;
      for(std::size_t i = 0; i < 3; ++i)
        for(std::size_t j = 0; j < 3; ++j)
          smoothing.add(triangle.nodes[i], displacement[triangle.nodes[j]],
                        along * (slope * triangle.gradients[i])
                                * (slope * triangle.gradients[j])
                            + across * (triangle.gradients[i] * triangle.gradients[j]));
    }
  }

  Values StepFrame::moved(const Values &increment, double spacing) const
  {
    Values result = level_set;
    for(std::size_t node = 0; node < result.size(); ++node)
      result[node] += increment[node];
    return without_zeros(std::move(result), spacing);
  }

  LocalVector StepFrame::as_unknowns(const Values &increment) const
  {
    LocalVector result = LocalVector::Zero(unknowns);
    for(std::size_t node = 0; node < increment.size(); ++node)
      if(displacement[node] >= 0)
        result[displacement[node]] = increment[node];
    return result;
  }
} // namespace meltfront::reference_fem::cut::conservative
