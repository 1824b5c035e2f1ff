#define BOOST_TEST_MODULE trimloop
#include <boost/test/unit_test.hpp>
