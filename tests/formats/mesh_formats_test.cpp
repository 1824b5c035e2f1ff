#include <boost/test/unit_test.hpp>

#include <cstring>
#include <nlohmann/json.hpp>

#include "formats/gltf/glb.h"
#include "formats/obj/obj.h"
#include "formats/ply/ply.h"
#include "formats/stl/stl.h"

namespace {

using namespace trimloop;

template <class T>
T at(const std::string& bytes, std::size_t offset) {
  BOOST_REQUIRE_LE(offset + sizeof(T), bytes.size());
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(mesh_formats)

BOOST_AUTO_TEST_CASE(stl_is_84_bytes_and_50_a_triangle) {
  const std::vector<stl::Triangle> triangles{{{0, 0, 1}, {{{1, 2, 3}, {4, 5, 6}, {7, 8, 9.5f}}}}, {}};
  const auto bytes = stl::write(triangles, "a header");
  BOOST_REQUIRE(bytes);
  BOOST_TEST(bytes->size() == 84u + 2 * 50u);
  BOOST_TEST(at<std::uint32_t>(*bytes, 80) == 2u);
  BOOST_TEST(at<float>(*bytes, 84 + 8) == 1.f);         // normal z
  BOOST_TEST(at<float>(*bytes, 84 + 12 + 32) == 9.5f);  // last corner z
  BOOST_TEST(at<std::uint16_t>(*bytes, 84 + 48) == 0);
}

BOOST_AUTO_TEST_CASE(stl_header_is_cut_to_80_bytes) {
  const auto bytes = stl::write({}, std::string(200, 'x'));
  BOOST_REQUIRE(bytes);
  BOOST_TEST(bytes->size() == 84u);
  BOOST_TEST(at<std::uint32_t>(*bytes, 80) == 0u);
}

BOOST_AUTO_TEST_CASE(ply_states_its_counts_and_has_that_many_bytes) {
  ply::Document document;
  document.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.25}};
  document.triangles = {{0, 1, 2}};
  document.colours = {{10, 20, 30}};
  const auto bytes = ply::write(document);
  BOOST_REQUIRE(bytes);
  const std::size_t end = bytes->find("end_header\n");
  BOOST_REQUIRE(end != std::string::npos);
  const std::size_t data = end + 11;
  BOOST_TEST(bytes->find("element vertex 3\n") < end);
  BOOST_TEST(bytes->find("element face 1\n") < end);
  BOOST_TEST(bytes->size() == data + 3 * 24 + 16);
  BOOST_TEST(at<double>(*bytes, data + 2 * 24 + 16) == 0.25);
  BOOST_TEST(at<std::uint8_t>(*bytes, data + 72) == 3);
  BOOST_TEST(at<std::uint32_t>(*bytes, data + 72 + 9) == 2u);
  BOOST_TEST(at<std::uint8_t>(*bytes, data + 72 + 15) == 30);
}

BOOST_AUTO_TEST_CASE(obj_counts_from_one_and_keeps_names_on_one_line) {
  obj::Document document;
  document.positions = {{0, 0, 0}, {0.1, 0, 0}, {0, 1, 0}};
  document.normals = {{0, 0, 1}};
  document.groups.push_back({"two words\n", {{0, 1, 2}}, {{0, 0, 0}}});
  const auto text = obj::write(document);
  BOOST_REQUIRE(text);
  BOOST_TEST(text->find("v 0.1 0 0\n") != std::string::npos);
  BOOST_TEST(text->find("g two_words_\n") != std::string::npos);
  BOOST_TEST(text->find("f 1//1 2//1 3//1\n") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(obj_refuses_a_group_without_its_normals) {
  obj::Document document;
  document.groups.push_back({"g", {{0, 1, 2}}, {}});
  BOOST_TEST(!obj::write(document));
}

BOOST_AUTO_TEST_CASE(glb_chunks_add_up_and_its_json_parses) {
  glb::Document document;
  document.generator = "test \"quoted\" \x01 \xe9";
  glb::Primitive primitive;
  primitive.positions = {{0, 0, 0}, {2, 0, 0}, {0, 3, -1}};
  primitive.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  primitive.triangles = {{0, 1, 2}};
  primitive.colour = {{0.5, 0.25, 0.125, 1}};
  document.meshes.push_back({"m", {primitive}});
  glb::Node node;
  node.name = "n";
  node.mesh = 0;
  document.nodes.push_back(node);
  document.roots = {0};
  const auto bytes = glb::write(document);
  BOOST_REQUIRE(bytes);
  BOOST_TEST(bytes->substr(0, 4) == "glTF");
  BOOST_TEST(at<std::uint32_t>(*bytes, 8) == bytes->size());
  const auto json_size = at<std::uint32_t>(*bytes, 12);
  BOOST_TEST(json_size % 4 == 0u);
  const auto json = nlohmann::json::parse(bytes->substr(20, json_size));
  const auto& position = json["accessors"][0];
  BOOST_TEST(position["count"] == 3);
  BOOST_TEST(position["max"][1] == 3.0);
  BOOST_TEST(position["min"][2] == -1.0);
  BOOST_TEST(json["materials"].size() == 1u);
  const auto binary_size = at<std::uint32_t>(*bytes, 20 + json_size);
  BOOST_TEST(20 + json_size + 8 + binary_size == bytes->size());
  BOOST_TEST(json["buffers"][0]["byteLength"] == 3 * 12 + 3 * 12 + 12);
}

BOOST_AUTO_TEST_CASE(glb_refuses_an_empty_mesh) {
  glb::Document document;
  document.meshes.push_back({"m", {}});
  BOOST_TEST(!glb::write(document));
}

BOOST_AUTO_TEST_SUITE_END()
