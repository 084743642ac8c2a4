#pragma once
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <vector>
#define TEST_CASE(name) TEST_CASE_(name, __COUNTER__)
#define TEST_CASE_(name, n) TEST_CASE__(name, n)
#define TEST_CASE__(name, n) static void t##n(); static Reg r##n(name, t##n); static void t##n()
struct Reg { Reg(const char* n, void (*f)()) { all().push_back({n, f}); } static std::vector<std::pair<const char*, void (*)()>>& all() { static std::vector<std::pair<const char*, void (*)()>> v; return v; } };
static int failures = 0;
#define FAIL(x) do { std::ostringstream o; o << x; std::cout << "FAIL " << o.str() << std::endl; ++failures; return; } while (0)
#define CHECK(x) do { if (!(x)) { std::cout << "CHECK failed: " #x << std::endl; ++failures; } } while (0)
#define REQUIRE CHECK
int main(int c, char** v) { for (auto& t : Reg::all()) if (c < 2 || std::string(t.first).find(v[1]) != std::string::npos) { std::cout << t.first << std::endl; t.second(); } return failures; }
