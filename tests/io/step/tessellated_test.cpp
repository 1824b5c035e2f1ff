// Tessellated shapes of AP242: closed forms, links to the exact faces, what is left out and said, and the way into mesh files.

#include <fmt/format.h>

#include <boost/test/unit_test.hpp>

#include "formats/stl/stl.h"
#include "io/io.h"
#include "kernel/check/measure.h"
#include "tests/support/paths.h"

using namespace trimloop;

namespace {

io::ReadResult read(const std::string& name) { return io::read(test::source_dir() / "tests/data/step" / (name + ".stp")); }

io::ReadResult shape(const std::string& instances) {
  return io::read_bytes("ISO-10303-21;HEADER;FILE_DESCRIPTION((''),'2;1');FILE_NAME('n','2026-01-01T00:00:00',('a'),('o'),'p','s','');"
                        "FILE_SCHEMA(('AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF'));ENDSEC;DATA;"
                        "#901=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));#902=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));"
                        "#903=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#901,#902))REPRESENTATION_CONTEXT('',''));"
                        "#900=TESSELLATED_SHAPE_REPRESENTATION('',(#1),#903);" + instances + "ENDSEC;END-ISO-10303-21;", "x.stp");
}
io::ReadResult face(const std::string& attributes) {
  return shape("#1=TRIANGULATED_FACE('',#2," + attributes + ");#2=COORDINATES_LIST('',4,((0.,0.,0.),(1.,0.,0.),(0.,1.,0.),(0.,0.,1.)));");
}
std::size_t triangles(const io::ReadResult& r) { return count(r.model).value().mesh_triangles; }

}  // namespace

BOOST_AUTO_TEST_SUITE(tessellated)

BOOST_AUTO_TEST_CASE(a_cube_of_strips_and_fans_is_closed_and_has_its_volume) {
  const io::ReadResult r = read("tessellated_cube");
  BOOST_TEST(r.report.items().empty());
  BOOST_REQUIRE(r.model.parts.at(0).meshes.size() == 1u);
  const PolygonMesh& cube = r.model.parts[0].meshes[0];
  BOOST_TEST(broken_promises(cube).empty());
  BOOST_TEST((cube.kind == BodyKind::Solid));
  BOOST_TEST(cube.points.size() == 8u);  // the two lists meet by coordinates; the point that nothing uses is not there
  BOOST_TEST(open_sides(cube) == 0u);
  BOOST_TEST(cube.triangle_count() == 12u);
  BOOST_TEST(volume(cube).value() == 25.4 * 25.4 * 25.4, boost::test_tools::tolerance(1e-13));
  BOOST_TEST(area(cube) == 6 * 25.4 * 25.4, boost::test_tools::tolerance(1e-13));
  BOOST_TEST(r.model[cube.attributes].name == "cube");
  BOOST_TEST(r.model[cube.faces.at(1).attributes].name == "top");
  BOOST_TEST(r.model[cube.faces[1].attributes].colour.value().g == 1);
  BOOST_TEST(!r.model[cube.faces[0].attributes].colour.has_value());
  BOOST_TEST(cube.faces[1].vertices[0].normal.z == 1);
  BOOST_TEST(cube.faces[2].vertices[0].normal.z == -1);
  BOOST_TEST(norm(cube.faces[0].vertices[0].normal) == 0);
}

BOOST_AUTO_TEST_CASE(sets_give_lines_points_and_a_moved_triangle) {
  const io::ReadResult r = read("tessellated_sets");
  BOOST_TEST(r.report.items().empty());
  const Part& part = r.model.parts.at(0);
  const auto m = measure(r.model, Limits{}).value();
  BOOST_TEST(part.curves.size() == 2u);
  BOOST_TEST(m.curve_length_mm == 9, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(part.points.size() == 2u);
  BOOST_TEST(m.mesh_area_mm2 == 6, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(bounding_box(part.meshes.at(0)).lo.x == 10);
}

BOOST_AUTO_TEST_CASE(a_mesh_stands_for_the_solid_and_the_faces_that_it_names) {
  const io::ReadResult r = read("tessellated_hybrid");
  BOOST_TEST(r.report.items().empty());
  const Part& part = r.model.parts.at(0);
  BOOST_REQUIRE(part.meshes.size() == 1u);
  BOOST_TEST(part.meshes[0].stands_for.index == 0u);
  for (std::uint32_t f = 0; f < 4; ++f) BOOST_TEST(part.meshes[0].faces.at(f).stands_for.index == f);
  const auto m = measure(r.model, Limits{}).value();
  BOOST_TEST(m.mesh_area_mm2 == 0);  // the solid is measured, not its repetition
  BOOST_TEST(m.volume_mm3.value() == 1. / 6, boost::test_tools::tolerance(1e-9));
  io::WriteOptions options;
  options.format = io::Format::Stl;
  BOOST_TEST(io::encode(r.model, r.source, options).value().triangles == 4u);
}

BOOST_AUTO_TEST_CASE(mesh_files_hold_the_triangles_as_they_are) {
  const io::ReadResult r = read("tessellated_cube");
  for (const io::Format format : {io::Format::Stl, io::Format::Obj, io::Format::Ply, io::Format::Glb}) {
    io::WriteOptions options;
    options.format = format;
    const auto written = io::encode(r.model, r.source, options);
    BOOST_REQUIRE(written.has_value());
    BOOST_TEST(written->triangles == 12u);
    BOOST_TEST(written->open_edges == 0u);
    BOOST_TEST(!written->bytes.empty());
  }
}

BOOST_AUTO_TEST_CASE(S43_what_cannot_be_used_is_left_out_and_said) {
  BOOST_TEST(triangles(face("4,(),$,(),((1,3,2),(1,2,4),(1,4,3),(2,3,4))")) == 4u);
  for (const char* bad : {"0", "5", "-1", "2147483648"}) {
    const io::ReadResult r = face(fmt::format("4,(),$,(),((1,2,3),(1,2,{}))", bad));
    BOOST_TEST(r.report.count("SP-G32") + r.report.count("SP-X05") == 1u, bad);
    BOOST_TEST(triangles(r) <= 1u);
  }
  const io::ReadResult by_index = face("3,(),$,(1,2,99),((1,2,3))");
  BOOST_TEST(by_index.report.count("SP-G32") == 2u);  // a triangle outside the list, and no triangle left
  const io::ReadResult normals = face("4,((0.,0.,1.),(0.,0.,1.)),$,(),((1,2,3))");
  BOOST_TEST(normals.report.count("SP-G32") == 1u);
  BOOST_TEST(triangles(normals) == 1u);
  BOOST_TEST(face("7,(),$,(),((1,2,3))").report.count("SP-G32") == 1u);
  BOOST_TEST(face("4,(),$,(),((1,2,2))").report.count("SP-G32") == 2u);
  BOOST_TEST(face("4,(),$,(),((1,2))").report.count("SP-G32") == 2u);
  BOOST_TEST(shape("#1=TESSELLATED_SHELL('',(),$);").report.count("SP-G32") == 1u);
  const io::ReadResult open = shape("#1=TESSELLATED_SOLID('',(#3),$);#3=TRIANGULATED_FACE('',#2,3,(),$,(),((1,2,3)));"
                                    "#2=COORDINATES_LIST('',3,((0.,0.,0.),(1.,0.,0.),(0.,1.,0.)));");
  BOOST_TEST(open.report.count("SP-G27") == 1u);
}

BOOST_AUTO_TEST_SUITE_END()
