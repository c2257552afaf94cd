#include <verification/report/page/markup.h>

#include <fmt/format.h>

#include <cctype>

namespace meltfront::verification
{
  Markup::Markup(std::string html)
    : source(std::move(html))
  {
  }

  Markup &Markup::operator+=(const Markup &other)
  {
    source += other.source;
    return *this;
  }

  const std::string &Markup::html() const
  {
    return source;
  }

  bool Markup::empty() const
  {
    return source.empty();
  }

  Markup operator+(Markup left, const Markup &right)
  {
    left += right;
    return left;
  }

  std::string escape(std::string_view plain)
  {
    std::string result;
    for(const char c : plain)
      switch(c)
      {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        if(static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t')
          result += c;
      }
    return result;
  }

  Markup text(std::string_view plain)
  {
    return Markup(escape(plain));
  }

  namespace
  {
    std::string opening(const std::string &name, const Attributes &attributes)
    {
      std::string tag = "<" + name;
      for(const auto &[key, value] : attributes)
        tag += fmt::format(" {}=\"{}\"", key, escape(value));
      return tag;
    }
  } // namespace

  Markup element(const std::string &name, const Attributes &attributes,
                 const Markup &content)
  {
    return Markup(opening(name, attributes) + ">" + content.html() + "</" + name + ">");
  }

  Markup element(const std::string &name, const Markup &content)
  {
    return element(name, {}, content);
  }

  Markup element(const std::string &name, const std::string &plain)
  {
    return element(name, {}, text(plain));
  }

  Markup void_element(const std::string &name, const Attributes &attributes)
  {
    return Markup(opening(name, attributes) + "/>");
  }

  Markup list(const std::string &name, const std::vector<Markup> &items)
  {
    Markup content;
    for(const Markup &item : items)
      content += element("li", item) + Markup("\n");
    return items.empty() ? Markup() : element(name, content);
  }

  std::string data_address(const std::string &media_type, std::string_view content)
  {
    std::string address = "data:" + media_type + ";charset=utf-8,";
    for(const char c : content)
    {
      const auto byte = static_cast<unsigned char>(c);
      if(std::isalnum(byte)
         || std::string_view("-_.~,").find(c) != std::string_view::npos)
        address += c;
      else
        address += fmt::format("%{:02X}", byte);
    }
    return address;
  }

  std::string plain_name(std::string_view name)
  {
    std::string result(name);
    for(char &c : result)
      if(!std::isalnum(static_cast<unsigned char>(c))
         && std::string_view("._-").find(c) == std::string_view::npos)
        c = '_';
    return result.empty() ? "_" : result;
  }
} // namespace meltfront::verification
