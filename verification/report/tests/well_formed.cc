#include <verification/report/tests/well_formed.h>

#include <regex>
#include <set>
#include <vector>

namespace meltfront::verification::fixture
{
  namespace
  {
    std::string near(const std::string &page, std::size_t at, const std::string &what)
    {
      return what + ": " + page.substr(at, 80);
    }

    std::string text_mistake(const std::string &text)
    {
      static const std::regex reference("^&(amp|lt|gt|quot|#39|#[0-9]+);");
      for(std::size_t at = text.find('&'); at != std::string::npos;
          at = text.find('&', at + 1))
        if(!std::regex_search(text.substr(at, 10), reference))
          return near(text, at, "bare &");
      return {};
    }

    std::string attribute_mistake(const std::string &attributes)
    {
      static const std::regex attribute(
          "^\\s+([a-zA-Z:-]+)\\s*=\\s*(\"[^\"<]*\"|'[^'<]*')");
      std::set<std::string> names;
      std::string rest = attributes;
      for(std::smatch found; std::regex_search(rest, found, attribute);
          rest = found.suffix())
      {
        if(!names.insert(found[1]).second)
          return near(rest, 0, "repeated attribute");
        if(const std::string mistake = text_mistake(found[2]); !mistake.empty())
          return mistake;
      }
      return rest.find_first_not_of(" \n\t") == std::string::npos
                 ? ""
                 : near(rest, 0, "not an attribute");
    }
  } // namespace

  std::string first_mistake(const std::string &page)
  {
    std::vector<std::string> open;
    std::size_t at = page.starts_with("<!DOCTYPE html>\n") ? 16 : 0;
    while(at < page.size())
    {
      const std::size_t tag = std::min(page.find('<', at), page.size());
      if(const std::string mistake = text_mistake(page.substr(at, tag - at));
         !mistake.empty())
        return mistake;
      if(tag == page.size())
        break;
      const std::size_t end = page.find('>', tag);
      if(end == std::string::npos)
        return near(page, tag, "tag without end");
      std::string inside = page.substr(tag + 1, end - tag - 1);
      const bool closing = inside.starts_with('/'), alone = inside.ends_with('/');
      if(closing)
        inside.erase(0, 1);
      if(alone)
        inside.pop_back();
      const std::size_t name_end = std::min(inside.find_first_of(" \n\t"), inside.size());
      const std::string name = inside.substr(0, name_end);
      if(name.empty() || !std::isalpha(static_cast<unsigned char>(name[0])))
        return near(page, tag, "bare <");
      if(const std::string mistake = attribute_mistake(inside.substr(name_end));
         !mistake.empty())
        return mistake;
      if(closing && (open.empty() || open.back() != name))
        return near(page, tag, "closes what is not open");
      if(closing)
        open.pop_back();
      else if(!alone)
        open.push_back(name);
      at = end + 1;
    }
    return open.empty() ? "" : "never closed: " + open.back();
  }
} // namespace meltfront::verification::fixture
