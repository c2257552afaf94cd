#include <reference_fem/enthalpy/distributed/conduction_runs.h>

#include <algorithm>
#include <limits>

namespace meltfront::reference_fem
{
  namespace
  {
    /** Of the entries of a node those with the nodes that are numbered before and after
     * it, where both conduct alike. */
    struct NodePair
    {
      NodePair(unsigned int node, const RunEntry *entries, std::size_t n)
      {
        const RunEntry *before = nullptr, *after = nullptr;
        for(const RunEntry *entry = entries; entry != entries + n; ++entry)
        {
          if(entry->column + 1 == node)
            before = entry;
          else if(entry->column == node + 1)
            after = entry;
          else
            apart = std::min(apart, entry->column > node ? entry->column - node
                                                         : node - entry->column);
        }
        if(before && after && before->value == after->value)
          conductance = before->value;
      }

      double conductance = 0;                                        ///< 0: no pair
      unsigned int apart = std::numeric_limits<unsigned int>::max(); ///< of the others
    };
  } // namespace

  void ConductionRuns::add_node(const std::vector<RunEntry> &conductances)
  {
    const auto node = static_cast<unsigned int>(diagonal.size());
    const NodePair pair(node, conductances.data(), conductances.size());
    // Within a run nodes conduct to those beside them only.
    const bool anew
        = pair.conductance == 0 || (!runs.empty() && pair.apart <= runs.back().rows + 1);
    add_row(node, conductances, anew);
    diagonal.push_back(0);
    for(const RunEntry &entry : conductances)
      diagonal.back() += entry.value;
    count += static_cast<long>(conductances.size()) + 1;
  }

  void ConductionRuns::close()
  {
    std::size_t longest = 0;
    for(const Run &run : runs)
    {
      RunEntry *const first = entries.data() + run.first_entry;
      Order order{0, run.entries, false};
      if(const NodePair pair(run.row, first, run.entries); pair.conductance > 0)
      {
        order.paired = true;
        order.within = pair.conductance;
        std::stable_partition(first, first + run.entries,
                              [&](const RunEntry &entry) {
                                return entry.column + 1 != run.row
                                       && entry.column != run.row + 1;
                              });
        order.others = run.entries - 2;
      }
      while(order.earlier < order.others && first[order.earlier].column < run.row)
        ++order.earlier;
      orders.push_back(order);
      longest = std::max<std::size_t>(longest, run.rows);
    }
    work.resize(longest);
  }

  ConductionMatrix ConductionRuns::expanded() const
  {
    ConductionMatrix result;
    result.diagonal = diagonal;
    result.row_start.reserve(diagonal.size() + 1);
    const std::size_t n_conductances = static_cast<std::size_t>(count) - diagonal.size();
    result.column.reserve(n_conductances);
    result.conductance.reserve(n_conductances);
    for(const Run &run : runs)
      for(unsigned int t = 0; t < run.rows; ++t)
      {
        for(std::size_t k = run.first_entry; k < run.first_entry + run.entries; ++k)
        {
          result.column.push_back(entries[k].column + t);
          result.conductance.push_back(entries[k].value);
        }
        result.row_start.push_back(result.column.size());
      }
    return result;
  }

  void ConductionRuns::sweep_from_zero(const double *b, const double *inverse,
                                       double *x) const
  {
    for(std::size_t r = 0; r < runs.size(); ++r)
    {
      const Run &run = runs[r];
      const Order &order = orders[r];
      const double *const right_side = b + run.row, *const scale = inverse + run.row;
      double *const here = x + run.row, *const supply = work.data();
      const std::size_t n = run.rows;
      if(order.earlier == 0)
        std::copy_n(right_side, n, supply);
      else
        sum_up(run.first_entry, order.earlier, n, x,
               [&](std::size_t t, double sum) { supply[t] = right_side[t] + sum; });
      if(!order.paired)
      {
        for(std::size_t t = 0; t < n; ++t)
          here[t] = scale[t] * supply[t];
        continue;
      }
      supply[0] += order.within * *(here - 1);
      for(std::size_t t = 0; t < n; t += 2)
        here[t] = scale[t] * supply[t];
      for(std::size_t t = 1; t + 1 < n; t += 2)
        here[t] = scale[t] * (supply[t] + order.within * (here[t - 1] + here[t + 1]));
      if(n % 2 == 0)
        here[n - 1] = scale[n - 1] * (supply[n - 1] + order.within * here[n - 2]);
    }
  }

  void ConductionRuns::residual_of_sweep(const double *x, const double *inverse,
                                         double *residual) const
  {
    for(std::size_t r = 0; r < runs.size(); ++r)
    {
      const Run &run = runs[r];
      const Order &order = orders[r];
      const double *const here = x + run.row, *const scale = inverse + run.row;
      double *const left = residual + run.row;
      const std::size_t n = run.rows;
      if(order.earlier == order.others)
        std::fill_n(left, n, 0);
      else
        sum_up(run.first_entry + order.earlier, order.others - order.earlier, n, x,
               [&](std::size_t t, double sum) { left[t] = scale[t] != 0 ? sum : 0; });
      if(!order.paired)
        continue;
      const auto add = [&](std::size_t t, double beside)
      { left[t] += scale[t] != 0 ? order.within * beside : 0; };
      add(0, here[1]);
      for(std::size_t t = 2; t < n; t += 2)
        add(t, here[t - 1] + here[t + 1]);
      if(n % 2 == 0)
        add(n - 1, here[n]);
    }
  }
} // namespace meltfront::reference_fem
