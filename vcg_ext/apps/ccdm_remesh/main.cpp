// SPDX-License-Identifier: GPL-3.0-or-later
// ccdm_remesh INPUT OUTPUT -n N: the remesher as a command, without Qt and without a display.
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>

#include <vcg/complex/algorithms/ccdm/mended_figures.h>
#include <vcg/complex/algorithms/ccdm_remeshing.h>
#include <vcg/complex/algorithms/mesh_quality.h>

#include "atomic_file.h"
#include "mesh_io.h"
#include "options.h"
#include "platform.h"
#include "report.h"

namespace {

using namespace ccdm_remesh;
using vcg::ccdm::Status;
using Remeshing = vcg::tri::CCDMRemeshing<Mesh>;

enum ExitStatus {
    Done = 0,
    WrongUsage = 2,
    Unreadable = 3,
    Refused = 4,
    NotWritten = 5,
    CheckFailed = 6,
    NotReached = 7,
    Interrupted = 128 // and the signal's number
};

volatile std::sig_atomic_t interrupted = 0; // the signal's number
bool showProgress = false;

bool OnProgress(const int at, const char *phase)
{
    if (showProgress) {
        std::fprintf(stderr, "\r[%-40.*s] %3d%% %-28s", at * 40 / 100, "########################################", at,
                     phase);
        if (at == 100)
            std::fputc('\n', stderr);
    }
    return interrupted == 0;
}

int ExitStatusOf(Status s)
{
    switch (s) {
    case Status::Done:
        return Done;
    case Status::Cancelled:
        return Interrupted + interrupted;
    // The arguments have been checked by themselves: what is left is wrong for this input.
    case Status::InvalidParameter:
    case Status::InvalidInput:
        return Refused;
    case Status::CheckFailed:
        return CheckFailed;
    case Status::NotReached:
        return NotReached;
    }
    return CheckFailed;
}

double SecondsSince(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// From file to file; the status and the message say how it ended.
void Remesh(const Options &options, RunSummary &run)
{
    const auto start = std::chrono::steady_clock::now();
    const auto end = [&](int status, const std::string &message) {
        run.status = status;
        run.message = message;
        run.seconds = SecondsSince(start);
    };
    const auto stopped = [&](const char *when) {
        if (interrupted != 0)
            end(Interrupted + interrupted, options.input + ": interrupted " + when);
        return interrupted != 0;
    };
    const std::string unwritable = FindWriteFault(options.output);
    if (!unwritable.empty())
        return end(NotWritten, options.output + ": " + unwritable);
    Mesh input, result;
    const ReadResult read = ReadMesh(options.input, input);
    if (!read.fault.empty())
        return end(Unreadable, options.input + ": " + read.fault);
    if (stopped("after it was read"))
        return;
    if (options.params.density == vcg::ccdm::DensityKind::Quality && !read.hasQuality)
        return end(Refused, options.input + ": it has no value per vertex to take the density from");
    run.engine = Remeshing::Do(input, result, options.params, OnProgress);
    run.engine.warnings.insert(run.engine.warnings.begin(), read.notes.begin(), read.notes.end());
    if (run.engine.status != Status::Done)
        return end(ExitStatusOf(run.engine.status), options.input + ": " + run.engine.message);
    if (stopped("before the result was written"))
        return;
    const std::string fault = WriteMesh(options.output, result);
    if (!fault.empty())
        return end(NotWritten, options.output + ": " + fault);
    if (!options.quiet || !options.report.empty()) {
        const auto written = std::chrono::steady_clock::now();
        if (stopped("after the result was written"))
            return;
        run.measured = vcg::ccdm::CompareMended(input, result, run.engine, options.params.threads != 1);
        run.engine.seconds.emplace_back("measuring", SecondsSince(written));
    }
    end(Done, "");
}

int Run(int argc, char **argv)
{
    Options options;
    const int usage = ParseArguments(argc, argv, options);
    if (usage >= 0)
        return usage;
    const std::string unwritable = options.report.empty() ? "" : FindWriteFault(options.report);
    if (!unwritable.empty()) {
        std::cerr << "ccdm_remesh: " << options.report << ": " << unwritable << '\n';
        return NotWritten;
    }
    showProgress = !options.quiet && IsTerminal(stderr);
    RunSummary run;
    try {
        Remesh(options, run);
    } catch (const std::bad_alloc &) {
        run.status = Refused;
        run.message = options.input + ": not enough memory";
    } catch (const std::exception &e) {
        run.status = CheckFailed;
        run.message = e.what();
    }
    if (run.status != Done)
        std::cerr << (showProgress ? "\n" : "") << "ccdm_remesh: " << run.message << '\n';
    else if (!options.quiet && run.measured)
        PrintTable(std::cout, run, *run.measured);
    if (!options.report.empty()) {
        const std::string fault = WriteReport(options, run);
        if (!fault.empty()) {
            std::cerr << "ccdm_remesh: " << options.report << ": " << fault << '\n';
            return run.status != Done ? run.status : NotWritten;
        }
    }
    return run.status;
}

} // namespace

int main(int argc, char **argv)
{
    OpenStandardStreams();
    CatchSignals([](int s) { interrupted = s; });
    try {
        return Run(argc, argv);
    } catch (const std::bad_alloc &) { // where there is not even enough to say it in more words, or for the report
        std::fputs("ccdm_remesh: not enough memory\n", stderr);
        return Refused;
    } catch (const std::exception &e) {
        std::fprintf(stderr, "ccdm_remesh: %s\n", e.what());
        return CheckFailed;
    }
}
