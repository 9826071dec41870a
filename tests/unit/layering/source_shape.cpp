#include "unit/layering/source_shape.hpp"

#include <algorithm>
#include <regex>

namespace ream::layering {
namespace {

/// Leaves out what lies between a place and the end of a comment or literal that begins there; 0: none does.
class Skipper {
 public:
  explicit Skipper(const std::string& text) : text_(text) {}

  /// How many characters the comment or literal at `i` has.
  size_t length_at(size_t i) const {
    if (starts(i, "//")) return end_of_line(i) - i;
    if (starts(i, "/*")) return after(i + 2, "*/") - i;
    if (starts(i, "R\"")) return after(i, ")" + text_.substr(i + 2, text_.find('(', i) - i - 2) + "\"") - i;
    if (text_[i] == '"') return after_literal(i, '"') - i;
    const bool in_number = i > 0 && std::isalnum(static_cast<unsigned char>(text_[i - 1])) != 0;
    if (text_[i] == '\'' && !in_number) return after_literal(i, '\'') - i;
    return 0;
  }
  bool is_literal(size_t i) const { return text_[i] != '/'; }

 private:
  bool starts(size_t i, const char* what) const {
    return text_.compare(i, std::char_traits<char>::length(what), what) == 0;
  }
  size_t end_of_line(size_t i) const { return std::min(text_.find('\n', i), text_.size()); }
  size_t after(size_t i, const std::string& mark) const {
    const size_t at = text_.find(mark, i);
    return at == std::string::npos ? text_.size() : at + mark.size();
  }
  size_t after_literal(size_t i, char quote) const {
    for (++i; i < text_.size() && text_[i] != quote; ++i)
      if (text_[i] == '\\') ++i;
    return std::min(i + 1, text_.size());
  }

  const std::string& text_;
};

std::string without_comments(const std::string& text) {
  const Skipper skipper(text);
  std::string bare;
  for (size_t i = 0; i < text.size();) {
    const size_t length = skipper.length_at(i);
    if (length == 0) {
      bare += text[i++];
      continue;
    }
    if (skipper.is_literal(i)) bare += "\"\"";
    bare.append(static_cast<size_t>(std::count(text.begin() + static_cast<long>(i),
                                               text.begin() + static_cast<long>(i + length), '\n')),
                '\n');
    i += length;
  }
  return bare;
}

std::string trimmed(const std::string& text) {
  const size_t first = text.find_first_not_of(" \n\t");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \n\t") - first + 1);
}

/// The part of a declaration before its first parenthesis, without template parameters.
std::string before_arguments(const std::string& head) {
  std::string flat;
  int depth = 0;
  for (size_t i = 0; i < head.size(); ++i) {
    const bool opens = head[i] == '<' && (i == 0 || head[i - 1] != '<') && head.compare(i, 2, "<<") != 0 &&
                       head.compare(i, 2, "<=") != 0;
    if (opens) ++depth;
    if (depth == 0 && head[i] == '(') break;
    if (depth == 0) flat += head[i];
    if (head[i] == '>' && depth > 0) --depth;
  }
  return flat;
}

enum class Kind { scope, type, function, other };

/// What a brace opens after `head`, the text since the last statement or brace.
Kind kind_of(const std::string& head) {
  static const std::regex type("(^|\\s)(class|struct|union|enum)\\s");
  static const std::regex scope("(^|\\s)(namespace|extern)(\\s|$)");
  static const std::regex control("^(if|for|while|switch|do|else|try|catch|return|case|default)\\b");
  const std::string trimmed_head = trimmed(head), start = before_arguments(trimmed_head);
  if (std::regex_search(start, scope) && trimmed_head.find('(') == std::string::npos) return Kind::scope;
  if (std::regex_search(start, type)) return Kind::type;
  if (trimmed_head.find('(') == std::string::npos || std::regex_search(start, control)) return Kind::other;
  const bool assigned = start.find('=') != std::string::npos && start.find("operator") == std::string::npos;
  // A body's brace stands apart; that of a value ("count_{0}") does not.
  return assigned || head.empty() || head.back() != ' ' ? Kind::other : Kind::function;
}

std::string without_access_labels(const std::string& head) {
  static const std::regex label("\\b(public|private|protected):");
  return std::regex_replace(head, label, " ");
}

struct Walk {
  std::vector<FunctionLines> functions;  ///< their places without the file
  Declarations declared;
};

bool is_function_declaration(const std::string& statement) {
  const std::string start = before_arguments(statement);
  static const std::regex no_function(
      "(^|\\s)(using|typedef|static_assert|friend|extern|class|struct|enum|namespace)(\\s|$)");
  return statement.find('(') != std::string::npos && start.size() < statement.size() &&
         !std::regex_search(start, no_function) &&
         (start.find('=') == std::string::npos || start.find("operator") != std::string::npos);
}

bool is_alias(const std::string& statement) {
  static const std::regex alias("(^|[\\s>])using\\s+\\w+\\s*=");
  return std::regex_search(statement, alias);
}

Walk walk(const std::string& text) {
  const std::string code = bare_code(text);
  Walk out;
  std::vector<Kind> open;
  std::string head;
  int line = 1, head_line = 1, function_line = 0, parentheses = 0;
  size_t function_depth = 0;
  const auto in_function = [&] { return function_depth > 0; };
  const auto at_namespace = [&] {
    return std::all_of(open.begin(), open.end(), [](Kind k) { return k == Kind::scope; });
  };
  for (const char c : code) {
    if (c == '\n') ++line;
    if (in_function()) {
      if (c == '{') open.push_back(Kind::other);
      if (c == '}') {
        open.pop_back();
        if (open.size() < function_depth) {
          out.functions.push_back({std::to_string(function_line), line - function_line + 1});
          function_depth = 0;
          head.clear();
        }
      }
      continue;
    }
    if (c == '(') ++parentheses;
    if (c == ')') --parentheses;
    if (c == '{') {
      Kind kind = parentheses > 0 ? Kind::other : kind_of(without_access_labels(head));
      if (kind == Kind::function && at_namespace()) ++out.declared.functions;
      if (kind == Kind::type && at_namespace()) ++out.declared.types;
      open.push_back(kind);
      if (kind == Kind::function) {
        function_line = head_line;
        function_depth = open.size();
      }
      if (kind != Kind::other) head.clear();
      continue;
    }
    if (c == '}') {
      const Kind kind = open.empty() ? Kind::other : open.back();
      if (!open.empty()) open.pop_back();
      if (kind != Kind::other) head.clear();
      continue;
    }
    const bool inside_value = !open.empty() && open.back() == Kind::other;
    if (inside_value) continue;
    if (c == ';' && parentheses == 0) {
      const std::string statement = trimmed(without_access_labels(head));
      if (at_namespace() && is_function_declaration(statement)) ++out.declared.functions;
      if (at_namespace() && is_alias(statement)) ++out.declared.types;
      head.clear();
      continue;
    }
    if (head.empty() && (c == ' ' || c == '\n')) continue;
    if (head.empty()) head_line = line;
    head += c;
    if (head == "public:" || head == "private:" || head == "protected:") head.clear();
  }
  return out;
}

}  // namespace

std::string bare_code(const std::string& text) {
  const std::string bare = without_comments(text);
  std::string code;
  bool directive = false, goes_on = false;
  size_t start = 0;
  while (start < bare.size()) {
    const size_t end = std::min(bare.find('\n', start), bare.size());
    const std::string line = bare.substr(start, end - start);
    directive = goes_on || trimmed(line).starts_with('#');
    goes_on = directive && line.ends_with('\\');
    if (!directive) code += line;
    code += '\n';
    start = end + 1;
  }
  return code;
}

std::vector<FunctionLines> function_lines(const std::string& path, const std::string& text) {
  std::vector<FunctionLines> functions = walk(text).functions;
  for (FunctionLines& function : functions) function.place.insert(0, path + ":");
  return functions;
}

Declarations declarations(const std::string& text) { return walk(text).declared; }

}  // namespace ream::layering
