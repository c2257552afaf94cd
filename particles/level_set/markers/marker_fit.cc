#include <cases/error.h>
#include <particles/level_set/markers/marker_fit.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace meltfront::particles::level_set
{
  namespace
  {
    /** Markers that advance with the same instructions. */
    constexpr std::size_t lanes = 4;

    /** Markers around a node, in spacings from it; filled up with weights of zero. */
    template <int dim>
    struct Cloud
    {
      std::array<std::vector<double>, dim> x, normal;
      std::vector<double> weight, distance, candidate;
      std::vector<double> magnitude; ///< scratch of quantiles
      std::size_t size = 0;

      explicit Cloud(std::size_t most)
      {
        const std::size_t length = (most / lanes + 1) * lanes;
        for(int d = 0; d < dim; ++d)
        {
          x[d].resize(length);
          normal[d].resize(length);
        }
        weight.resize(length);
        distance.resize(length);
        candidate.resize(length);
        magnitude.resize(length);
      }

      /** Whole lanes of markers, the last of no weight. */
      std::size_t fill_up()
      {
        const std::size_t end = (size + lanes - 1) / lanes * lanes;
        for(std::size_t p = size; p < end; ++p)
        {
          for(int d = 0; d < dim; ++d)
            x[d][p] = 0;
          weight[p] = distance[p] = 0;
        }
        return end;
      }

      void move(std::size_t from, std::size_t to)
      {
        for(int d = 0; d < dim; ++d)
          x[d][to] = x[d][from];
        weight[to] = weight[from];
        distance[to] = distance[from];
        candidate[to] = candidate[from];
      }
    };

    /** Monomials of a fit: products first, the constant last, so that its coefficient is
     * the first that elimination yields. */
    template <int dim, bool quadratic>
    struct Monomials
    {
      static constexpr int products = quadratic ? dim * (dim + 1) / 2 : 0;
      static constexpr int terms = products + dim + 1;

      static void evaluate(const Cloud<dim> &cloud, std::size_t p,
                           double (&value)[terms][lanes])
      {
        int term = 0;
        if constexpr(quadratic)
          for(int i = 0; i < dim; ++i)
            for(int j = i; j < dim; ++j, ++term)
              for(std::size_t lane = 0; lane < lanes; ++lane)
                value[term][lane] = cloud.x[i][p + lane] * cloud.x[j][p + lane];
        for(int i = 0; i < dim; ++i, ++term)
          for(std::size_t lane = 0; lane < lanes; ++lane)
            value[term][lane] = cloud.x[i][p + lane];
        for(std::size_t lane = 0; lane < lanes; ++lane)
          value[term][lane] = 1;
      }
    };

    double sum_of(const double (&parts)[lanes])
    {
      return (parts[0] + parts[2]) + (parts[1] + parts[3]);
    }

    /** Constant of a symmetric system by Cholesky's elimination, the constant last. */
    template <int terms>
    std::optional<double> last_unknown(double (&matrix)[terms][terms],
                                       double (&right)[terms], double least_pivot)
    {
      double largest = 0;
      for(int k = 0; k < terms; ++k)
        largest = std::max(largest, matrix[k][k]);
      for(int k = 0; k < terms; ++k)
      {
        if(!(matrix[k][k] > least_pivot * largest))
          return std::nullopt;
        for(int i = k + 1; i < terms; ++i)
        {
          const double factor = matrix[i][k] / matrix[k][k];
          for(int j = k + 1; j <= i; ++j)
            matrix[i][j] -= factor * matrix[j][k];
          right[i] -= factor * right[k];
        }
      }
      return right[terms - 1] / matrix[terms - 1][terms - 1];
    }

    /** Value at the node of the polynomial that fits the distances best. */
    template <int dim, bool quadratic>
    std::optional<double> fit(Cloud<dim> &cloud, double least_pivot)
    {
      constexpr int terms = Monomials<dim, quadratic>::terms;
      double sums[terms][terms][lanes] = {}, sums_right[terms][lanes] = {};
      const std::size_t end = cloud.fill_up();
      for(std::size_t p = 0; p < end; p += lanes)
      {
        double value[terms][lanes];
        Monomials<dim, quadratic>::evaluate(cloud, p, value);
        for(int i = 0; i < terms; ++i)
        {
          double weighted[lanes];
          for(std::size_t lane = 0; lane < lanes; ++lane)
            weighted[lane] = cloud.weight[p + lane] * value[i][lane];
          for(int j = 0; j <= i; ++j)
            for(std::size_t lane = 0; lane < lanes; ++lane)
              sums[i][j][lane] += weighted[lane] * value[j][lane];
          for(std::size_t lane = 0; lane < lanes; ++lane)
            sums_right[i][lane] += weighted[lane] * cloud.distance[p + lane];
        }
      }
      double matrix[terms][terms], right[terms];
      for(int i = 0; i < terms; ++i)
      {
        for(int j = 0; j <= i; ++j)
          matrix[i][j] = sum_of(sums[i][j]);
        right[i] = sum_of(sums_right[i]);
      }
      return last_unknown<terms>(matrix, right, least_pivot);
    }

    /** Sets nodes one by one; one per thread. */
    template <int dim, bool clustered>
    class NodeFit
    {
    public:
      NodeFit(const Grid &grid, const Markers &markers, const MarkerCells &cells,
              const FitParameters &parameters)
        : grid(grid)
        , markers(markers)
        , cells(cells)
        , parameters(parameters)
        , cloud(cells.fullest() << dim)
      {
      }

      void set(std::size_t node, double &phi)
      {
        if(!(std::abs(phi) <= parameters.band * grid.spacing()))
          return;
        gather(node);
        std::optional<double> value;
        if(total >= parameters.weight && nearest <= parameters.nearest)
          value = value_at_node();
        if(value)
          phi = *value * grid.spacing();
        else
          ++counts.left;
      }

      FitCounts counts;

    private:
      /** Markers in the cells around a node, near enough to the front. */
      void gather(std::size_t node)
      {
        const Position centre = grid.position(node);
        const double scale = 1 / grid.spacing();
        cloud.size = 0;
        total = 0;
        nearest = std::numeric_limits<double>::infinity();
        for(int corner = (1 << dim) - 1; corner >= 0; --corner)
        {
          const auto [begin, end] = cells.markers_of(lower_cell(node, corner));
          for(std::size_t p = begin; p < end; ++p)
          {
            // taken over without a branch: the next one overwrites what does not count
            const double distance = scale * markers.distance[p];
            const bool counts = std::abs(distance) <= parameters.furthest;
            const std::size_t at = cloud.size;
            double weight = 1;
            for(int d = 0; d < dim; ++d)
            {
              const double x = scale * (markers.position[d][p] - centre[d]);
              cloud.x[d][at] = x;
              weight *= 1 - std::abs(x);
            }
            cloud.weight[at] = weight;
            cloud.distance[at] = distance;
            if constexpr(clustered)
              gather_plane(p, at);
            cloud.size += counts;
            total += counts ? weight : 0;
            nearest = std::min(nearest, std::abs(distance));
          }
        }
      }

      void gather_plane(std::size_t marker, std::size_t at)
      {
        double candidate = cloud.distance[at];
        for(int d = 0; d < dim; ++d)
        {
          cloud.normal[d][at] = markers.normal[d][marker];
          candidate -= cloud.normal[d][at] * cloud.x[d][at];
        }
        cloud.candidate[at] = candidate;
      }

      std::uint32_t lower_cell(std::size_t node, int corner) const
      {
        for(int d = 0; d < dim; ++d)
          if(corner >> d & 1)
            node -= static_cast<std::size_t>(grid.stride(d));
        return static_cast<std::uint32_t>(node);
      }

      std::optional<double> quadratic()
      {
        if(cloud.size < static_cast<std::size_t>(parameters.quadratic))
          return std::nullopt;
        return fit<dim, true>(cloud, parameters.pivot);
      }

      std::optional<double> value_at_node()
      {
        if constexpr(clustered)
          return value_of_nearest_front();
        else
          return value_of_all();
      }

      std::optional<double> value_of_all()
      {
        if(const std::optional<double> value = quadratic())
        {
          ++counts.quadratic;
          return value;
        }
        if(cloud.size < static_cast<std::size_t>(parameters.linear))
          return std::nullopt;
        const std::optional<double> value = fit<dim, false>(cloud, parameters.pivot);
        counts.linear += value.has_value();
        return value;
      }

      std::optional<double> value_of_nearest_front()
      {
        keep_nearest_front();
        double sum = 0, weights = 0;
        for(std::size_t p = 0; p < cloud.size; ++p)
        {
          sum += cloud.weight[p] * cloud.candidate[p];
          weights += cloud.weight[p];
        }
        if(!(weights > 0))
          return std::nullopt;
        const double mean = sum / weights;
        const std::optional<double> value = quadratic();
        if(value && std::abs(*value - mean) <= parameters.tolerance)
        {
          ++counts.quadratic;
          return value;
        }
        ++counts.mean;
        return mean;
      }

      void keep_nearest_front()
      {
        const std::size_t reference = reference_marker();
        std::array<double, dim> normal;
        for(int d = 0; d < dim; ++d)
          normal[d] = cloud.normal[d][reference];
        const double candidate = cloud.candidate[reference];
        std::size_t kept = 0;
        for(std::size_t p = 0; p < cloud.size; ++p)
        {
          double cosine = 0;
          for(int d = 0; d < dim; ++d)
            cosine += normal[d] * cloud.normal[d][p];
          const bool close = std::abs(cloud.candidate[p] - candidate) < parameters.window;
          cloud.move(p, kept);
          kept += close & (cosine > parameters.alignment);
        }
        cloud.size = kept;
      }

      /** The last marker of the low quantile of |c_p|. */
      std::size_t reference_marker()
      {
        for(std::size_t p = 0; p < cloud.size; ++p)
          cloud.magnitude[p] = std::abs(cloud.candidate[p]);
        const auto rank = static_cast<std::ptrdiff_t>(parameters.quantile
                                                      * static_cast<double>(cloud.size));
        std::nth_element(cloud.magnitude.begin(), cloud.magnitude.begin() + rank,
                         cloud.magnitude.begin()
                             + static_cast<std::ptrdiff_t>(cloud.size));
        const double value = cloud.magnitude[static_cast<std::size_t>(rank)];
        std::size_t p = 0;
        while(std::abs(cloud.candidate[p]) != value)
          ++p;
        return p;
      }

      const Grid &grid;
      const Markers &markers;
      const MarkerCells &cells;
      const FitParameters parameters;
      Cloud<dim> cloud;
      double total = 0, nearest = 0;
    };

    template <int dim, bool clustered>
    FitCounts fit_nodes(const Grid &grid, const Markers &markers,
                        const MarkerCells &cells, const FitParameters &parameters,
                        std::span<double> phi, int threads)
    {
      FitCounts all;
      const std::vector<std::uint32_t> &nodes = cells.nodes();
#pragma omp parallel num_threads(threads)
      {
        NodeFit<dim, clustered> node_fit(grid, markers, cells, parameters);
#pragma omp for schedule(static)
        for(std::size_t n = 0; n < nodes.size(); ++n)
          node_fit.set(nodes[n], phi[nodes[n]]);
#pragma omp critical
        {
          all.quadratic += node_fit.counts.quadratic;
          all.linear += node_fit.counts.linear;
          all.mean += node_fit.counts.mean;
          all.left += node_fit.counts.left;
        }
      }
      return all;
    }
  } // namespace

  FitParameters FitParameters::in(const int dimension)
  {
    FitParameters result;
    if(dimension == 3)
    {
      result.quadratic = 16;
      result.linear = 6;
    }
    return result;
  }

  FitCounts fit_level_set(const Grid &grid, const Markers &markers,
                          const MarkerCells &cells, const FitParameters &parameters,
                          const std::span<double> phi, const int threads)
  {
    if(parameters.clustered && !markers.with_normals() && markers.size() > 0)
      throw cases::InputError("fits by clusters need markers with normals");
    const bool plane = grid.dimension() == 2;
    const auto fit = parameters.clustered
                         ? plane ? fit_nodes<2, true> : fit_nodes<3, true>
                     : plane ? fit_nodes<2, false>
                             : fit_nodes<3, false>;
    return fit(grid, markers, cells, parameters, phi, threads);
  }
} // namespace meltfront::particles::level_set
