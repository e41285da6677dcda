#pragma once
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace reachlab {

inline void expectIn(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << "\nis not in: " << text;
}
inline void expectNotIn(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_EQ(text.find(part), std::string::npos) << part << "\nis in: " << text;
}

}  // namespace reachlab
