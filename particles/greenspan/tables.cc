#include <cases/data_folder.h>
#include <cases/error.h>
#include <particles/greenspan/tables.h>

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>

namespace meltfront::particles::greenspan
{
  namespace
  {
    constexpr int number_of_particles[] = {28, 46};

    using Row = std::vector<std::string>;

    /** The rows of a file of comma-separated values below its heading. */
    std::vector<Row> read_rows(const std::string &path, std::size_t columns)
    {
      std::ifstream file(path);
      if(!file)
        throw cases::OutputError(fmt::format("cannot read the table {}", path));
      std::vector<Row> rows;
      std::string line, cell;
      std::getline(file, line);
      while(std::getline(file, line))
      {
        std::istringstream cells(line);
        Row row;
        while(row.size() + 1 < columns && std::getline(cells, cell, ','))
          row.push_back(cell);
        std::getline(cells, cell); // the last may hold commas of a sentence
        row.push_back(cell);
        if(row.size() != columns)
          throw cases::InputError(fmt::format("{}:{}: the line has {} columns, not {}",
                                              path, rows.size() + 2, row.size(),
                                              columns));
        rows.push_back(row);
      }
      return rows;
    }

    double number(const std::string &word, const std::string &path, std::size_t row)
    {
      std::size_t read = 0;
      double value = NAN;
      try
      {
        value = std::stod(word, &read);
      }
      catch(const std::exception &)
      {
      }
      while(read < word.size() && std::isspace(static_cast<unsigned char>(word[read])))
        ++read;
      if(!std::isfinite(value) || read != word.size())
        throw cases::InputError(
            fmt::format("{}:{}: '{}' is no finite number", path, row + 2, word));
      return value;
    }

    std::vector<double> &column(ParticleState &state, const std::string &name)
    {
      if(name == "x" || name == "y")
        return state.position[name == "y"];
      if(name == "vx" || name == "vy")
        return state.velocity[name == "vy"];
      throw cases::InputError(fmt::format("a table has no column '{}'", name));
    }

    void apply_errata(ParticleState &state, const std::string &folder, int table)
    {
      const std::string path = folder + "/greenspan_table_errata.csv";
      const auto rows = read_rows(path, 6);
      for(std::size_t r = 0; r < rows.size(); ++r)
      {
        if(number(rows[r][0], path, r) != table)
          continue;
        std::vector<double> &values = column(state, rows[r][2]);
        const double particle = number(rows[r][1], path, r);
        if(!(particle >= 1 && particle <= double(values.size())))
          throw cases::InputError(
              fmt::format("{}:{}: table {} has no row {}", path, r + 2, table, particle));
        double &value = values[static_cast<std::size_t>(particle) - 1];
        if(value != number(rows[r][3], path, r))
          throw cases::InputError(fmt::format("{}:{}: the table has {} there, not {}",
                                              path, r + 2, value, rows[r][3]));
        value = number(rows[r][4], path, r);
      }
    }
  } // namespace

  ParticleState read_table(const std::string &folder, int table, Errata errata)
  {
    if(table != 1 && table != 2)
      throw cases::InputError(
          fmt::format("there is no table {} of particle solids, only 1 and 2", table));
    const std::string path = fmt::format("{}/greenspan_table{}.csv", folder, table);
    const auto rows = read_rows(path, 5);
    const std::size_t expected = number_of_particles[table - 1];
    if(rows.size() != expected)
      throw cases::InputError(
          fmt::format("{} has {} particles, not {}", path, rows.size(), expected));
    ParticleState state;
    for(std::size_t r = 0; r < rows.size(); ++r)
    {
      if(number(rows[r][0], path, r) != double(r + 1))
        throw cases::InputError(fmt::format("{}:{}: particle {} stands where {} belongs",
                                            path, r + 2, rows[r][0], r + 1));
      for(int d = 0; d < 2; ++d)
      {
        state.position[d].push_back(number(rows[r][1 + d], path, r));
        state.velocity[d].push_back(number(rows[r][3 + d], path, r));
      }
    }
    if(errata == Errata::applied)
      apply_errata(state, folder, table);
    return state;
  }

  ParticleState read_table(int table, Errata errata)
  {
    return read_table(cases::data_path("cases/data"), table, errata);
  }
} // namespace meltfront::particles::greenspan
