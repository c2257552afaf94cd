#include <cases/error.h>
#include <cases/gmsh_file.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace meltfront::cases
{
  namespace
  {
    /** An element as the file has it. */
    struct Element
    {
      long type = 0;
      long group = 0; ///< physical group, 0: of none
      std::vector<unsigned int> vertices;
    };

    struct ElementType
    {
      int dimension;
      unsigned int vertices;
      std::optional<CellKind> cell;
    };

    /** gmsh's numbers of linear elements. */
    const ElementType *linear_type(long number)
    {
      static const std::map<long, ElementType> types{{15, {0, 1, {}}},
                                                     {1, {1, 2, {}}},
                                                     {2, {2, 3, CellKind::triangle}},
                                                     {3, {2, 4, CellKind::quadrilateral}},
                                                     {4, {3, 4, CellKind::tetrahedron}},
                                                     {5, {3, 8, CellKind::hexahedron}}};
      const auto found = types.find(number);
      return found == types.end() ? nullptr : &found->second;
    }

    class GmshReader
    {
    public:
      GmshReader(const std::string &text, const std::string &file)
        : text(text)
        , file(file)
      {
      }

      /** Everything, section by section. */
      void read();

      BodyMeshData cells_of(int dimension) const;

    private:
      [[noreturn]] void fail(const std::string &problem) const
      {
        throw InputError(fmt::format("{}:{}: {}", file, line_number, problem));
      }

      std::optional<std::string_view> next_line();
      std::string_view line_of(const char *section);
      std::vector<double> row(const char *section, std::size_t at_least);
      long whole(double number) const;

      void read_format();
      void read_names();
      void read_entities();
      void read_nodes();
      void read_elements();
      void add_node(double id, const Position &place);
      void add_element(long type, long group, const std::vector<double> &numbers,
                       std::size_t first);
      void end(const char *section);

      std::string name_of(int dimension, long group) const;

      const std::string &text;
      const std::string &file;
      std::size_t place = 0;
      int line_number = 0;
      bool blocks = false; ///< format 4: nodes and elements by entity
      std::map<std::pair<int, long>, std::string> names; ///< by dimension and group
      std::map<std::pair<int, long>, long> group_of_entity;
      std::vector<Position> vertices;
      std::unordered_map<long, unsigned int> vertex_of_id;
      std::vector<Element> elements;
    };

    std::optional<std::string_view> GmshReader::next_line()
    {
      while(place < text.size())
      {
        const std::size_t end = std::min(text.find('\n', place), text.size());
        std::string_view line(text.data() + place, end - place);
        place = end + 1;
        ++line_number;
        while(!line.empty() && (line.back() == '\r' || line.back() == ' '))
          line.remove_suffix(1);
        if(!line.empty())
          return line;
      }
      return {};
    }

    std::string_view GmshReader::line_of(const char *section)
    {
      const auto line = next_line();
      if(!line)
        fail(fmt::format("the file breaks off in the section ${}", section));
      return *line;
    }

    std::vector<double> GmshReader::row(const char *section, std::size_t at_least)
    {
      const std::string_view line = line_of(section);
      std::vector<double> numbers;
      const char *at = line.data(), *const end = at + line.size();
      while(at != end)
      {
        if(*at == ' ' || *at == '\t')
        {
          ++at;
          continue;
        }
        double number = 0;
        const auto [stop, error] = std::from_chars(at, end, number);
        if(error != std::errc() || !std::isfinite(number)
           || (stop != end && *stop != ' ' && *stop != '\t'))
          fail(fmt::format("section ${} needs numbers here", section));
        numbers.push_back(number);
        at = stop;
      }
      if(numbers.size() < at_least)
        fail(fmt::format("section ${} needs {} numbers here, not {}", section, at_least,
                         numbers.size()));
      return numbers;
    }

    long GmshReader::whole(double number) const
    {
      constexpr double largest = 1e15;
      if(!(std::abs(number) <= largest) || number != std::floor(number))
        fail("a whole number is needed here");
      return static_cast<long>(number);
    }

    void GmshReader::end(const char *section)
    {
      if(line_of(section) != fmt::format("$End{}", section))
        fail(fmt::format("section ${} goes on where it should end", section));
    }

    void GmshReader::read_format()
    {
      const std::vector<double> format = row("MeshFormat", 3);
      if(format[1] != 0)
        fail("the file is binary: gmsh writes text with Mesh.Binary = 0");
      blocks = format[0] == 4.1;
      if(!blocks && !(format[0] >= 2 && format[0] < 3))
        fail(fmt::format("the file has gmsh's format {}; 2.2 and 4.1 are read "
                         "(Mesh.MshFileVersion = 4.1)",
                         format[0]));
      end("MeshFormat");
    }

    void GmshReader::read_names()
    {
      const long count = whole(row("PhysicalNames", 1)[0]);
      for(long i = 0; i < count; ++i)
      {
        const std::string_view line = line_of("PhysicalNames");
        const std::size_t open = line.find('"'), close = line.rfind('"');
        const std::string numbers(line.substr(0, std::min(open, line.size())));
        int dimension = 0;
        long group = 0;
        if(open == std::string_view::npos || close <= open + 1
           || std::sscanf(numbers.c_str(), "%d %ld", &dimension, &group) != 2)
          fail("a physical name needs a dimension, a number and a name in quotes");
        names[{dimension, group}] = line.substr(open + 1, close - open - 1);
      }
      end("PhysicalNames");
    }

    /** Of format 4: the group of each entity. */
    void GmshReader::read_entities()
    {
      const std::vector<double> counts = row("Entities", 4);
      for(int dimension = 0; dimension < 4; ++dimension)
        for(long i = whole(counts[static_cast<std::size_t>(dimension)]); i > 0; --i)
        {
          // The number, a point or the corners of a box, and how many groups follow.
          const std::size_t before = dimension == 0 ? 4 : 7;
          const std::vector<double> entity = row("Entities", before + 1);
          const long groups = whole(entity[before]);
          if(groups == 0)
            continue;
          if(groups != 1)
            fail("an entity is of several physical groups, and has to be of one");
          if(entity.size() < before + 2)
            fail("an entity's physical group is missing");
          group_of_entity[{dimension, whole(entity[0])}]
              = std::abs(whole(entity[before + 1]));
        }
      end("Entities");
    }

    void GmshReader::add_node(double id, const Position &at)
    {
      if(!vertex_of_id.emplace(whole(id), static_cast<unsigned int>(vertices.size()))
              .second)
        fail(fmt::format("node {} stands here for the second time", whole(id)));
      vertices.push_back(at);
    }

    void GmshReader::read_nodes()
    {
      const std::vector<double> head = row("Nodes", blocks ? 4 : 1);
      if(!blocks)
        for(long i = whole(head[0]); i > 0; --i)
        {
          const std::vector<double> node = row("Nodes", 4);
          add_node(node[0], {node[1], node[2], node[3]});
        }
      else
        for(long block = whole(head[0]); block > 0; --block)
        {
          const long count = whole(row("Nodes", 4)[3]);
          std::vector<double> ids;
          for(long i = 0; i < count; ++i)
            ids.push_back(row("Nodes", 1)[0]);
          for(const double id : ids)
          {
            const std::vector<double> at = row("Nodes", 3);
            add_node(id, {at[0], at[1], at[2]});
          }
        }
      end("Nodes");
    }

    void GmshReader::add_element(long type, long group,
                                 const std::vector<double> &numbers, std::size_t first)
    {
      const ElementType *known = linear_type(type);
      if(!known)
        fail(type == 6 || type == 7
                 ? "the file holds prisms or pyramids; all cells have to be triangles, "
                   "quadrilaterals, tetrahedra or hexahedra"
                 : fmt::format("elements of gmsh's type {} are not read: they have to be "
                               "of first order (Mesh.ElementOrder = 1)",
                               type));
      if(numbers.size() != first + known->vertices)
        fail(fmt::format("this element needs {} nodes", known->vertices));
      Element element{type, group, {}};
      for(std::size_t i = first; i < numbers.size(); ++i)
      {
        const auto found = vertex_of_id.find(whole(numbers[i]));
        if(found == vertex_of_id.end())
          fail(fmt::format("there is no node {}", whole(numbers[i])));
        element.vertices.push_back(found->second);
      }
      elements.push_back(std::move(element));
    }

    void GmshReader::read_elements()
    {
      const std::vector<double> head = row("Elements", blocks ? 4 : 1);
      if(!blocks)
        for(long i = whole(head[0]); i > 0; --i)
        {
          const std::vector<double> element = row("Elements", 4);
          const long tags = whole(element[2]);
          if(tags < 0 || static_cast<std::size_t>(tags) + 3 >= element.size())
            fail("an element needs a number, a type, its tags and its nodes");
          add_element(whole(element[1]), tags > 0 ? std::abs(whole(element[3])) : 0,
                      element, 3 + static_cast<std::size_t>(tags));
        }
      else
        for(long block = whole(head[0]); block > 0; --block)
        {
          const std::vector<double> of_entity = row("Elements", 4);
          const auto group = group_of_entity.find(
              {static_cast<int>(whole(of_entity[0])), whole(of_entity[1])});
          for(long i = whole(of_entity[3]); i > 0; --i)
            add_element(whole(of_entity[2]),
                        group == group_of_entity.end() ? 0 : group->second,
                        row("Elements", 2), 1);
        }
      end("Elements");
    }

    void GmshReader::read()
    {
      while(const auto line = next_line())
      {
        if(vertices.empty() && line_number == 1 && *line != "$MeshFormat")
          fail("this is no mesh file of gmsh: it does not begin with $MeshFormat");
        if(*line == "$MeshFormat")
          read_format();
        else if(*line == "$PhysicalNames")
          read_names();
        else if(*line == "$Entities")
          read_entities();
        else if(*line == "$Nodes")
          read_nodes();
        else if(*line == "$Elements")
          read_elements();
        else if(*line == "$PartitionedEntities")
          fail("the mesh is partitioned, and has to be whole");
        else if(line->starts_with("$"))
        {
          const std::string section(line->substr(1));
          while(line_of(section.c_str()) != "$End" + section)
            ;
        }
        else
          fail("a section is to begin here");
      }
    }

    std::string GmshReader::name_of(int dimension, long group) const
    {
      const auto found = names.find({dimension, group});
      return found == names.end() ? std::to_string(group) : found->second;
    }

    BodyMeshData GmshReader::cells_of(int dimension) const
    {
      BodyMeshData result;
      std::optional<CellKind> kind;
      int highest = 0;
      for(const Element &element : elements)
        highest = std::max(highest, linear_type(element.type)->dimension);
      if(highest < 2)
        throw InputError(fmt::format("{}: the mesh holds no cells", file));
      if(highest != dimension)
        throw InputError(
            fmt::format("{}: the mesh has {} dimensions, and the domain has {}", file,
                        highest, dimension));
      std::map<long, unsigned int> materials, walls;
      for(const Element &element : elements)
      {
        const ElementType &type = *linear_type(element.type);
        if(type.dimension == dimension)
        {
          if(kind && *kind != *type.cell)
            throw InputError(fmt::format("{}: the mesh holds {} and {}; all cells have "
                                         "to be of one kind",
                                         file, to_string(*kind), to_string(*type.cell)));
          kind = type.cell;
          std::vector<unsigned int> cell = element.vertices;
          if(cell.size() >= 4 && *kind != CellKind::tetrahedron) // gmsh goes around
            std::swap(cell[2], cell[3]);
          if(cell.size() == 8)
            std::swap(cell[6], cell[7]);
          result.cells.insert(result.cells.end(), cell.begin(), cell.end());
          result.material_of_cell.push_back(
              materials
                  .emplace(element.group, static_cast<unsigned int>(materials.size()))
                  .first->second);
        }
        else if(type.dimension == dimension - 1 && element.group != 0)
          result.faces.push_back(
              {element.vertices,
               walls.emplace(element.group, static_cast<unsigned int>(walls.size()))
                   .first->second});
      }
      result.kind = *kind;
      result.vertices = vertices;
      result.materials.resize(materials.size());
      for(const auto &[group, index] : materials)
        result.materials[index] = name_of(dimension, group);
      result.walls.resize(walls.size());
      for(const auto &[group, index] : walls)
        result.walls[index] = name_of(dimension - 1, group);
      return result;
    }

    /** The plane is that of x and y. */
    void flatten(BodyMeshData &mesh, const std::string &file)
    {
      const double z = mesh.vertices[mesh.cells.front()][2];
      for(const unsigned int v : mesh.cells)
        if(std::abs(mesh.vertices[v][2] - z)
           > 1e-9
                 * (std::abs(mesh.vertices[v][0]) + std::abs(mesh.vertices[v][1])
                    + std::abs(z)))
          throw InputError(fmt::format(
              "{}: the cells are of the plane, but their z varies ({:.6g}, {:.6g})", file,
              z, mesh.vertices[v][2]));
      for(Position &p : mesh.vertices)
        p[2] = 0;
    }
  } // namespace

  BodyMeshData read_gmsh(const std::string &text, const std::string &file, int dimension)
  {
    GmshReader reader(text, file);
    reader.read();
    BodyMeshData mesh = reader.cells_of(dimension);
    if(dimension == 2)
      flatten(mesh, file);
    return mesh;
  }
} // namespace meltfront::cases
