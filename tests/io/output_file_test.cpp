// SPDX-License-Identifier: BSL-1.0
#include <cerrno>
#include <cstdio>
#include <string>

#include <gtest/gtest.h>

#include "io_test_support.hpp"
#include <gnomon/core/error.hpp>
#include <gnomon/io/input.hpp>
#include <gnomon/io/output_file.hpp>

#if defined(__unix__)
#include <csignal>

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace {

TEST(io_output_file, appears_only_when_committed) {
    const std::string path = io_test::scratch_path("new");
    std::remove(path.c_str());
    {
        gnomon::io::output_file file(path);
        file.write("half");
        EXPECT_FALSE(io_test::exists(path));
        file.write(" and half");
        file.commit();
    }
    EXPECT_EQ(gnomon::io::load(path).bytes, "half and half");
    EXPECT_FALSE(io_test::exists(path + ".part0"));
}

TEST(io_output_file, leaves_an_older_file_alone_unless_committed) {
    const std::string path = io_test::scratch_file("old", "old");
    {
        gnomon::io::output_file file(path);
        file.write("new");
    }
    EXPECT_EQ(gnomon::io::load(path).bytes, "old");
    EXPECT_FALSE(io_test::exists(path + ".part0"));
    gnomon::io::replace_file(path, "new");
    EXPECT_EQ(gnomon::io::load(path).bytes, "new");
}

TEST(io_output_file, overwrites_no_file_of_the_users) {
    const std::string path = io_test::scratch_path("busy");
    const std::string other = io_test::scratch_file("busy.part0", "mine");
    gnomon::io::replace_file(path, "new");
    EXPECT_EQ(gnomon::io::load(other).bytes, "mine");
    EXPECT_EQ(gnomon::io::load(path).bytes, "new");
}

#if defined(__unix__)
TEST(io_output_file, writes_to_where_a_link_leads) {
    const std::string target = io_test::scratch_file("target", "old");
    const std::string link = io_test::scratch_path("link");
    std::remove(link.c_str());
    ASSERT_EQ(symlink(target.c_str(), link.c_str()), 0);
    gnomon::io::replace_file(link, "new");
    EXPECT_EQ(gnomon::io::load(target).bytes, "new");
    std::remove(target.c_str());
    EXPECT_FALSE(io_test::exists(link));  // still a link, now to nothing
    std::remove(link.c_str());
}

TEST(io_output_file, replaces_no_device_and_no_pipe) {
    EXPECT_THROW(gnomon::io::replace_file("/dev/null", "x"), gnomon::error);
    const std::string pipe = io_test::scratch_path("pipe");
    std::remove(pipe.c_str());
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_THROW(gnomon::io::replace_file(pipe, "x"), gnomon::error);
    std::remove(pipe.c_str());
}
#endif

TEST(io_output_file, refuses_a_missing_directory_and_a_directory) {
    EXPECT_THROW(gnomon::io::replace_file(io_test::scratch_path("no") + "/such/file", "x"),
                 gnomon::error);
    const std::string directory = testing::TempDir() + ".";
    EXPECT_THROW(gnomon::io::replace_file(directory, "x"), gnomon::error);
    EXPECT_FALSE(io_test::exists(directory + ".part0"));
}

#if defined(__unix__)
TEST(io_output_file, leaves_nothing_when_the_disk_is_full) {
    const std::string path = io_test::scratch_path("full");
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    auto* const handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit tight = before;
    tight.rlim_cur = 1000;
    for (const std::size_t size : {1001U, 100000U}) {  // seen by fclose, seen by fwrite
        std::string reason;
        ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &tight), 0);
        try {
            gnomon::io::replace_file(path, std::string(size, 'x'));
        } catch (const gnomon::error& e) {
            reason = e.what();
        }
        ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
        EXPECT_NE(reason.find("too large"), std::string::npos) << reason;
        EXPECT_FALSE(io_test::exists(path));
        EXPECT_FALSE(io_test::exists(path + ".part0"));
    }
    std::signal(SIGXFSZ, handler);
}
#endif

}  // namespace
