#include <reference_fem/enthalpy/lattice_matrix.h>

#include <algorithm>
#include <stdexcept>

namespace meltfront::reference_fem
{
  namespace
  {
    using Direction = LatticeMatrix::Direction;

    /** row[i] -= a[i] x[i + d], round the ends. */
    void subtract_ahead(int n, int d, const double *a, const double *x, double *row)
    {
      const int first = d < 0 ? 1 : 0, last = d > 0 ? n - 1 : n;
      for(int i = first; i < last; ++i)
        row[i] -= a[i] * x[i + d];
      if(d > 0)
        row[n - 1] -= a[n - 1] * x[0];
      else if(d < 0)
        row[0] -= a[0] * x[n - 1];
    }

    /** row[i + d] -= a[i] x[i], round the ends. */
    void subtract_behind(int n, int d, const double *a, const double *x, double *row)
    {
      const int first = d < 0 ? 1 : 0, last = d > 0 ? n - 1 : n;
      for(int i = first; i < last; ++i)
        row[i + d] -= a[i] * x[i];
      if(d > 0)
        row[0] -= a[n - 1] * x[n - 1];
      else if(d < 0)
        row[n - 1] -= a[0] * x[0];
    }

    /** Of two neighbours one is ahead of the other: the later in z, else in y, else in x.
     */
    bool is_ahead(int x, int y, int z)
    {
      return z != 0 ? z > 0 : y != 0 ? y > 0 : x > 0;
    }
  } // namespace

  LatticeMatrix::LatticeMatrix(const LatticeLevel &level, const ConductionMatrix &network)
    : level(level)
  {
    for(int d = 0; d < 3; ++d)
      if(d == 0 || level.line[d].nodes() > 1)
      {
        directions.emplace_back()[d] = 1;
        couplings.emplace_back(level.size());
      }
    take(network);
  }

  void LatticeMatrix::take(const ConductionMatrix &network)
  {
    diagonal = network.diagonal;
    const auto nx = static_cast<std::size_t>(level.row_length());
    const auto ny = static_cast<std::size_t>(level.line[1].nodes());
    std::size_t found = 0;
    for(std::size_t i = 0; i < level.size(); ++i)
    {
      const std::array<int, 3> place{static_cast<int>(i % nx),
                                     static_cast<int>(i / nx % ny),
                                     static_cast<int>(i / nx / ny)};
      for(std::size_t s = 0; s < directions.size(); ++s)
      {
        const auto [dx, dy, dz] = directions[s];
        couplings[s][i] = 0;
        // Two nodes round a period are one pair.
        const int d = dx ? 0 : dy ? 1 : 2, along = level.line[d].nodes();
        if(along <= 2 && place[d] + 1 == along)
          continue;
        const std::size_t neighbour = level.row(place[1] + dy, place[2] + dz) * nx
                                      + level.line[0].wrapped(place[0] + dx);
        for(std::size_t k = network.row_start[i]; k < network.row_start[i + 1]; ++k)
          if(network.column[k] == neighbour)
          {
            couplings[s][i] = -network.conductance[k];
            found += 2;
          }
      }
    }
    if(found != network.column.size())
      throw std::logic_error("nodes of a lattice are joined along its axes only");
  }

  LatticeMatrix::LatticeMatrix(const LatticeLevel &level)
    : diagonal(level.size())
    , level(level)
  {
    for(int z = 0; z <= 1; ++z)
      for(int y = -1; y <= 1; ++y)
        for(int x = -1; x <= 1; ++x)
          if(is_ahead(x, y, z) && (y == 0 || level.line[1].nodes() > 1)
             && (z == 0 || level.line[2].nodes() > 1))
          {
            directions.push_back({x, y, z});
            couplings.emplace_back(level.size(), 0.);
          }
    // The direction along x, (1, 0, 0), is the first that is ahead.
  }

  void LatticeMatrix::subtract_other_rows(int y, int z, const std::vector<double> &x,
                                          double *row) const
  {
    const int n = level.row_length();
    for(std::size_t s = 1; s < directions.size(); ++s)
    {
      const auto [dx, dy, dz] = directions[s];
      const std::size_t here = std::size_t(level.row(y, z)) * n;
      const std::size_t ahead = std::size_t(level.row(y + dy, z + dz)) * n;
      const std::size_t behind = std::size_t(level.row(y - dy, z - dz)) * n;
      const double *a = couplings[s].data();
      subtract_ahead(n, dx, a + here, x.data() + ahead, row);
      subtract_behind(n, dx, a + behind, x.data() + behind, row);
    }
  }

  void LatticeMatrix::subtract_product(int y, int z,
                                       const std::vector<double> &diagonal_of,
                                       const std::vector<double> &x, double *row) const
  {
    const int n = level.row_length();
    const std::size_t first = std::size_t(level.row(y, z)) * n;
    const double *a = couplings[0].data() + first, *values = x.data() + first;
    for(int i = 0; i < n; ++i)
      row[i] -= diagonal_of[first + i] * values[i];
    subtract_ahead(n, 1, a, values, row);
    subtract_behind(n, 1, a, values, row);
    subtract_other_rows(y, z, x, row);
  }

  void LatticeMatrix::subtract_product(const std::vector<double> &diagonal_of,
                                       const std::vector<double> &x,
                                       std::vector<double> &y) const
  {
    std::size_t first = 0;
    for(int z = 0; z < level.line[2].nodes(); ++z)
      for(int row = 0; row < level.line[1].nodes(); ++row, first += level.row_length())
        subtract_product(row, z, diagonal_of, x, y.data() + first);
  }

  void LatticeMatrix::restrict_residual(const std::vector<double> &diagonal_of,
                                        const char *mask,
                                        const std::vector<double> &right_side,
                                        const std::vector<double> &x,
                                        std::vector<double> &on_coarse) const
  {
    const auto n = static_cast<std::size_t>(level.row_length());
    std::vector<double> row(n), work;
    std::fill(on_coarse.begin(), on_coarse.end(), 0);
    std::size_t first = 0;
    for(int z = 0; z < level.line[2].nodes(); ++z)
      for(int y = 0; y < level.line[1].nodes(); ++y, first += n)
      {
        std::copy_n(right_side.begin() + static_cast<std::ptrdiff_t>(first), n,
                    row.begin());
        subtract_product(y, z, diagonal_of, x, row.data());
        if(mask)
          for(std::size_t i = 0; i < n; ++i)
            row[i] = mask[first + i] ? row[i] : 0;
        level.restrict_row(y, z, row.data(), work, on_coarse);
      }
  }

  void LatticeMatrix::restrict_from(const LatticeMatrix &finer,
                                    const std::vector<double> &finer_diagonal,
                                    const char *mask)
  {
    std::fill(diagonal.begin(), diagonal.end(), 0);
    for(std::vector<double> &coupling : couplings)
      std::fill(coupling.begin(), coupling.end(), 0);
    const LatticeLevel &fine = finer.level;
    for(int z = 0; z < fine.line[2].nodes(); ++z)
      for(int y = 0; y < fine.line[1].nodes(); ++y)
      {
        // A pair of nodes adds to both of its entries; so does half of the diagonal with
        // itself.
        add_restricted(finer, finer_diagonal.data(), {0, 0, 0}, 0.5, mask, y, z);
        for(std::size_t s = 0; s < finer.directions.size(); ++s)
          add_restricted(finer, finer.couplings[s].data(), finer.directions[s], 1, mask,
                         y, z);
      }
  }

  /** Add what the entries of a row of the finer matrix with their neighbours in a
   * direction leave on this level. */
  void LatticeMatrix::add_restricted(const LatticeMatrix &finer, const double *values,
                                     const Direction &direction, double factor,
                                     const char *mask, int y, int z)
  {
    const LatticeLevel &fine = finer.level;
    const auto [dx, dy, dz] = direction;
    const int nx = fine.row_length(), coarse_nx = level.row_length();
    const std::size_t first = std::size_t(fine.row(y, z)) * nx;
    const std::size_t other = std::size_t(fine.row(y + dy, z + dz)) * nx;
    const auto share = [](const LatticeLine::Place &place, int upper)
    { return upper ? place.share : 1 - place.share; };
    for(int pick = 0; pick < 16; ++pick)
    {
      const int zp = pick & 1, yp = pick >> 1 & 1, zq = pick >> 2 & 1, yq = pick >> 3;
      const LatticeLine::Place &y_here = fine.line[1].place(y),
                               &y_there = fine.line[1].place(y + dy);
      const LatticeLine::Place &z_here = fine.line[2].place(z),
                               &z_there = fine.line[2].place(z + dz);
      const double weight = factor * share(y_here, yp) * share(z_here, zp)
                            * share(y_there, yq) * share(z_there, zq);
      if(weight == 0)
        continue;
      const int py = y_here.lower + yp, pz = z_here.lower + zp;
      const int qy = y_there.lower + yq, qz = z_there.lower + zq;
      const std::size_t p_row = std::size_t(level.row(py, pz)) * coarse_nx;
      const std::size_t q_row = std::size_t(level.row(qy, qz)) * coarse_nx;
      // Where entries go by how far q is from p along x: kept at the one behind.
      struct Target
      {
        double *entries = nullptr;
        bool at_p = true;
        double times = 1;
      };
      std::array<Target, 3> targets;
      for(int d = -1; d <= 1; ++d)
      {
        Target &target = targets[static_cast<std::size_t>(d + 1)];
        const int ey = qy - py, ez = qz - pz;
        if(d == 0 && ey == 0 && ez == 0)
        {
          target = {diagonal.data() + p_row, true, 2};
          continue;
        }
        const bool ahead = is_ahead(d, ey, ez);
        const Direction wanted = ahead ? Direction{d, ey, ez} : Direction{-d, -ey, -ez};
        const auto found = std::find(directions.begin(), directions.end(), wanted);
        if(found != directions.end())
          target = {couplings[static_cast<std::size_t>(found - directions.begin())].data()
                        + (ahead ? p_row : q_row),
                    ahead, 1};
      }
      const LatticeLine &x = fine.line[0];
      for(int i = 0; i < nx; ++i)
      {
        const double value = weight * values[first + i];
        if(value == 0)
          continue;
        if(mask && !(mask[first + i] && mask[other + x.wrapped(i + dx)]))
          continue;
        const LatticeLine::Place &here = x.place(i), &there = x.place(i + dx);
        const int apart = there.lower - here.lower;
        const auto add = [&](int p, int q, double entry)
        {
          const Target &target = targets[static_cast<std::size_t>(apart + q - p + 1)];
          const int at = x.wrapped_coarse(target.at_p ? here.lower + p : there.lower + q);
          target.entries[at] += target.times * entry;
        };
        add(0, 0, value * (1 - here.share) * (1 - there.share));
        if(here.share > 0)
          add(1, 0, value * here.share * (1 - there.share));
        if(there.share > 0)
        {
          add(0, 1, value * (1 - here.share) * there.share);
          if(here.share > 0)
            add(1, 1, value * here.share * there.share);
        }
      }
    }
  }
} // namespace meltfront::reference_fem
