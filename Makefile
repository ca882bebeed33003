# stickslip: build, test, verify.  "make help" lists the targets; objects live in build/.
CC       ?= cc
CFLAGS   ?= -O2 -g
PREFIX   ?= /usr/local
BINDIR   ?= $(PREFIX)/bin
LIBDIR   ?= $(PREFIX)/lib
INCDIR   ?= $(PREFIX)/include
MANDIR   ?= $(PREFIX)/share/man
PYTHON   ?= /usr/bin/python3
# where Python modules go: /usr has one folder for all versions, /usr/local one for each
PYDIR    ?= $(PREFIX)/lib/$(if $(filter /usr,$(PREFIX)),python3,python$(shell $(PYTHON) -c 'import sys; print("%d.%d" % sys.version_info[:2])' || echo 3))/dist-packages
B        ?= build
LONG     ?= 500
RELEASE  ?= trixie
# MPI=1 builds, and installs, a program of which mpirun starts many: stickslip sweep shares its work among them
MPI      ?=
MPICC    ?= mpicc
DATADIR  ?= $(PREFIX)/share/stickslip
COMPDIR  ?= $(PREFIX)/share/bash-completion/completions
ZSHDIR   ?= $(PREFIX)/share/zsh/site-functions
FISHDIR  ?= $(PREFIX)/share/fish/vendor_completions.d

WARN  = -Wall -Wextra -Wshadow -Wconversion -Wmissing-prototypes
# the same roundings by every compiler and level: where there is an FMA gcc 12 fuses a*b+c in short vectors in spite of -ffp-contract=off
UNFUSED = -fno-tree-slp-vectorize
FMA  := $(shell $(CC) $(CFLAGS) $(EXTRA) -dM -E -x c /dev/null 2>/dev/null | grep -c '__FP_FAST_FMA ')
STD   = -std=c17 -D_POSIX_C_SOURCE=200809L -ffp-contract=off $(if $(filter 0,$(FMA)),,$(UNFUSED)) -fPIC -pthread -fvisibility=hidden
# none changes a bit of a result; bounds of copies are checked only where the compiler optimises and no sanitizer does it
HARDEN = -fstack-protector-strong $(if $(findstring sanitize,$(EXTRA)),,$(if $(filter -O1 -O2 -O3 -Os,$(CFLAGS)),-U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=3))
# addresses that a run draws, and tables of functions that nothing can write to once it runs
LINK   = -Wl,-z,relro,-z,now
PIE    = -pie $(LINK)
# the public headers; what they mark with SS_API is all that the libraries export
API   = include
SO    = libstickslip.so.0
VERSION = $(shell sed -n 's/^.define SS_VERSION  *"\(.*\)"/\1/p' $(API)/stickslip/status.h)
# FLINT 3 holds Arb; before it Arb is a library of its own, libflint-arb on Debian and libarb elsewhere
ARB   = $(shell for l in flint-arb arb; do echo 'int main(void){return 0;}' | $(CC) -x c - -l$$l -o /dev/null 2>/dev/null && echo -l$$l && break; done)
# Calcium too (rational functions over Q in several variables)
CALCIUM = $(shell echo 'int main(void){return 0;}' | $(CC) -x c - -lcalcium -o /dev/null 2>/dev/null && echo -lcalcium)
# SUNDIALS' CVODE is a peer in bench/ where it is installed (libsundials-dev)
CVODE = -lsundials_cvode -lsundials_nvecserial
PEERS := $(shell printf '\043include <cvode/cvode.h>\nint main(void){return 0;}\n' | $(CC) $(CFLAGS) -x c - $(CVODE) -o /dev/null 2>/dev/null && echo $(CVODE))
LIBS  = $(CALCIUM) $(ARB) -lflint -lmpfr -lgmp -lgsl -lgslcblas -lnettle -lm -ldl
ALL   = $(STD) $(WARN) $(HARDEN) -Iinclude -Isrc -DSTICKSLIP_DATADIR='"$(DATADIR)"' $(CFLAGS) $(EXTRA)

CLI   = $(filter-out %_mpi.c,$(sort $(wildcard src/cli/*.c)))
RANKS = $(CLI:%.c=$(B)/mpi/%.o) $(B)/mpi/src/cli/sweep_mpi.o
SRC   = $(filter-out src/cli/%,$(sort $(wildcard src/*/*.c)))
BENCH = $(sort $(wildcard bench/*.c))
TEST  = $(sort $(wildcard tests/*.c))
FUZZ  = reader latex model claims scene system json report options certificate quotes
# one for each tests/check_*.c; those that take longest are begun first
SLOW  = commands html mutate scene certify report hostile cli messages plan mech_orbits mech jacobian stable pictures exact words complete sweep argument verdicts
SUITES = $(SLOW) $(filter-out main $(SLOW),$(patsubst tests/check_%.c,%,$(wildcard tests/check_*.c)))
# make quick: suites that find most in a second
QUICK = num digits base expr latex edit tape model dynamics map given argument law routes behaviour audit value diff verdicts
# processes at a time
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
# seconds for each target of make fuzz; where what it finds new goes
FUZZ_SECONDS ?= 10
FOBJ  = $(FUZZ:%=$(B)/tests/fuzz/%.o) $(B)/tests/fuzz/file.o $(B)/tests/fuzz/replay.o
# what is a text in another language: src/report/page.css is the array of characters page_css
PARTS = $(sort $(foreach kind,css js svg html md,$(wildcard src/*/*.$(kind))))
OBJ   = $(SRC:%.c=$(B)/%.o) $(PARTS:%=$(B)/%.o)
BOBJ  = $(BENCH:%.c=$(B)/%.o)
TOBJ  = $(TEST:%.c=$(B)/%.o)
# tests wait for what they call: optimising them costs more than it saves
TEST_LEVEL = -O1
PKGS  = gcc libc6-dev make pkg-config libgsl-dev libmpfr-dev libgmp-dev libflint-dev nettle-dev check python3 python3-mpmath python3-jsonschema python3-sympy
OLD   = libflint-arb-dev libcalcium-dev

.PHONY: deps all quick long quick-input quick-paper check check-build check-suites digests verify mutate bench stability atlas scenes lint asan fuzz fresh cover format install uninstall clean help
all: $(B)/stickslip $(B)/$(SO) $(B)/libstickslip.a $(B)/stickslip-checker $(if $(MPI),$(B)/mpi/stickslip) ## build the program, the library and the checker (default)

deps: ## install what is missing (Debian, Ubuntu), else say what to install
	@sh tools/deps.sh $(PKGS) -- $(OLD)

$(B)/stickslip: $(B)/src/main.o $(CLI:%.c=$(B)/%.o) $(BOBJ) $(B)/internal.a
	$(CC) $(CFLAGS) $(EXTRA) $(PIE) -o $@ $^ $(PEERS) $(LIBS)

$(B)/mpi/stickslip: $(B)/src/main.o $(RANKS) $(BOBJ) $(B)/internal.a
	OMPI_CC='$(CC)' MPICH_CC='$(CC)' $(MPICC) $(CFLAGS) $(EXTRA) $(PIE) -o $@ $^ $(PEERS) $(LIBS)

$(B)/mpi/%.o: %.c Makefile
	@mkdir -p $(@D)
	OMPI_CC='$(CC)' MPICH_CC='$(CC)' $(MPICC) $(ALL) -I. -DSTICKSLIP_MPI -MMD -MP -c -o $@ $<

# shares no source with the program
$(B)/stickslip-checker: $(wildcard verify/checker/*.[ch]) Makefile
	@mkdir -p $(@D)
	$(CC) $(STD) $(WARN) $(HARDEN) $(CFLAGS) $(EXTRA) $(PIE) -o $@ $(filter %.c,$^) $(ARB) -lflint -lmpfr -lgmp -lm

# what the program and the tests are linked with
$(B)/internal.a: $(OBJ)
	@rm -f $@
	ar qcs $@ $^

# the static library: one object, in which every name but the public ones is local
$(B)/libstickslip.a: $(OBJ)
	@rm -f $@
	$(CC) -r -nostdlib -o $(B)/libstickslip.o $^
	objcopy --localize-hidden $(B)/libstickslip.o
	ar qcs $@ $(B)/libstickslip.o

$(B)/$(SO): $(OBJ)
	$(CC) $(CFLAGS) $(EXTRA) -shared $(LINK) -Wl,-soname,$(SO) -o $@ $^ $(LIBS)

$(B)/check: $(TOBJ) $(BOBJ) $(B)/internal.a
	$(CC) $(CFLAGS) $(EXTRA) -o $@ $^ $(PEERS) $$(pkg-config --libs check) $(LIBS)

# a fuzz target on the files of its corpus, and under libFuzzer
FUZZ_ON = $(B)/tests/fuzz/file.o $(B)/src/cli/options.o $(B)/src/cli/range.o $(B)/internal.a
$(B)/replay-%: $(B)/tests/fuzz/%.o $(B)/tests/fuzz/replay.o $(FUZZ_ON)
	$(CC) $(CFLAGS) $(EXTRA) -o $@ $^ $(LIBS)

$(B)/fuzz-%: $(B)/tests/fuzz/%.o $(FUZZ_ON)
	$(CC) $(CFLAGS) $(EXTRA) -fsanitize=fuzzer -o $@ $^ $(LIBS)

.SECONDARY: $(FOBJ)
$(B)/faults.so: tests/preload/faults.c Makefile
	@mkdir -p $(@D)
	$(CC) -std=c17 $(WARN) -O2 -fPIC -shared -o $@ $<

$(B)/tests/%.o: tests/%.c Makefile
	@mkdir -p $(@D)
	$(CC) $(ALL) $(TEST_LEVEL) -I. -MMD -MP -c -o $@ $<

# objects that were made without CVODE are made again once it is there, and the other way
$(BOBJ): $(B)/cvode.$(if $(PEERS),there,absent)
$(B)/cvode.%:
	@mkdir -p $(@D); rm -f $(B)/cvode.*; touch $@

$(B)/src/cli/%.o: EXTRA_INCLUDE = -I.
# vectorised: no flag here may change a bit of a result
$(B)/src/explore/batch.o: EXTRA_INCLUDE = -O3 -fno-math-errno -fno-trapping-math $(UNFUSED)
$(B)/bench/%.o: EXTRA_INCLUDE = -I. $(if $(PEERS),-DSTICKSLIP_SUNDIALS)
$(B)/%.o: %.c Makefile
	@mkdir -p $(@D)
	$(CC) $(ALL) $(EXTRA_INCLUDE) -MMD -MP -c -o $@ $<

$(PARTS:%=$(B)/%.o): $(B)/%.o: % Makefile
	@mkdir -p $(@D)
	{ echo 'const char $(subst .,_,$(<F))[] ='; sed 's/[\\"]/\\&/g; s/.*/"&\\n"/' $<; echo ';'; } | $(CC) $(ALL) -x c -c -o $@ -

-include $(OBJ:.o=.d) $(TOBJ:.o=.d) $(FOBJ:.o=.d) $(BOBJ:.o=.d) $(CLI:%.c=$(B)/%.d) $(RANKS:.o=.d) $(B)/src/main.d

verify: ## audit the paper: writes reports/paper/, fails when a verdict differs from its record
	@$(MAKE) --no-print-directory -j$(JOBS) $(B)/stickslip $(B)/stickslip-checker
	@$(B)/stickslip plot paper --out reports/paper > /dev/null
	$(B)/stickslip verify

mutate: $(B)/stickslip ## damage every formula by the token, and what stands beside them by class: writes reports/mutation/; TEXT=FILE: a copy of the paper's text
	$(B)/stickslip mutate --count all $(if $(TEXT),--text $(TEXT)) --out reports/mutation

bench: $(B)/stickslip ## error against run time, by every method: writes reports/bench/
	rm -f $(B)/peers/peers.tsv
	$(B)/stickslip bench --inputs $(B)/peers
	-$(PYTHON) bench/peers/peers.py $(B)/peers
	$(B)/stickslip bench --out reports/bench $$([ ! -f $(B)/peers/peers.tsv ] || echo --peers $(B)/peers/peers.tsv)
	$(PYTHON) tools/readme.py

stability: $(B)/stickslip ## where the formulas lose digits, and why; stiff scenes: writes reports/stability/
	$(B)/stickslip stability --after stable --out reports/stability
	$(B)/stickslip bench --job studies --out reports/stability

atlas: $(B)/stickslip ## which orbits there are and where they are stable, over three planes: writes reports/atlas/
	for x in e1=2:4 chi=0.5:0.95 V=0.5:2; do \
	  $(B)/stickslip plot paper --over $$x --over e2=0.5:3 --out reports/atlas/$${x%%=*}-e2 || exit 1; done

scenes: $(B)/stickslip ## what each scene leaves out, and what it costs: writes reports/scenes/ and verify/costs.tsv
	$(B)/stickslip bench --job scenes --out reports/scenes
	mv reports/scenes/scenes-costs.tsv verify/costs.tsv

check: ## run the tests, JOBS suites at a time; with MPI=1 those of mpirun too
	@$(MAKE) --no-print-directory -j$(JOBS) check-build
	@[ -n "$(EXTRA)" ] || CC='$(CC)' sh tools/check-install.sh $(B)
	@$(MAKE) --no-print-directory check-suites
	@echo "$(words $(SUITES)) suites of tests passed"

quick: ## in a minute: laws of numbers, reader, model and orbits, the paper's verdicts, bad input, digests
	@$(MAKE) --no-print-directory -s -j$(JOBS) all $(B)/check $(FUZZ:%=$(B)/replay-%)
	@$(MAKE) --no-print-directory -j$(JOBS) -k -Otarget $(QUICK:%=suite-%) quick-input quick-paper
	@$(PYTHON) tools/digests.py $(B)/stickslip --quick
	@echo "quick: $(words $(QUICK)) suites of tests, bad input and the paper's verdicts passed"

long: check-build ## hours: the tests with every case where make check tries some, every forgery of certificates, and LONG scenes of all classes and four times as many random ones held against an independent program: writes reports/differ.md
	@STICKSLIP_TESTS=all $(MAKE) --no-print-directory check-suites
	$(PYTHON) tests/forge.py $(B)/stickslip paper above-one chi-near-0 chi-near-1 near-ta paper-times other-word chain3 driven two-loads beside-wall soft-wall den-hartog
	$(PYTHON) tests/oracle/differ.py $(B)/stickslip --count $(LONG) --random $$((4 * $(LONG))) --seed 21 --page reports/differ.md

quick-input:
	@CK_RUN_CASE=input CK_RUN_SUITE=hostile STICKSLIP=$(B)/stickslip PYTHON=$(PYTHON) $(B)/check

quick-paper:
	@$(B)/stickslip verify paper --quiet --out $(B)/quick

check-build: all $(B)/check $(B)/faults.so $(FUZZ:%=$(B)/replay-%)

# the audit of the paper first, which many suites read
check-suites:
	@sh tests/whole.sh $(B)/stickslip $(B)/whole
	@STICKSLIP_WHOLE=$(B)/whole $(MAKE) --no-print-directory -j$(JOBS) -k -Otarget $(SUITES:%=suite-%)

digests: $(B)/stickslip ## hold the bytes of outputs against tests/digests.tsv (DIGESTS=--quick: a part; --record: anew)
	@$(PYTHON) tools/digests.py $(B)/stickslip $(DIGESTS)

# one suite of the tests: make suite-cli, after make check-build
suite-%:
	@CK_RUN_SUITE=$* STICKSLIP=$(B)/stickslip STICKSLIP_MPI=$(if $(MPI),$(B)/mpi/stickslip) PYTHON=$(PYTHON) $(B)/check

lint: all ## formatting, arrows between rooms, static analysis
	sh tools/lint.sh $(B)

asan: ## build and test under AddressSanitizer and UndefinedBehaviorSanitizer, each suite in one process, without the longest tests
	CK_FORK=no CK_EXCLUDE_TAGS=long $(MAKE) B=$(B)/asan CFLAGS="-O1 -g -fno-omit-frame-pointer" EXTRA="-fsanitize=address,undefined -fno-sanitize-recover=all" check

# What AddressSanitizer keeps of freed memory is no memory of the program's: with its 256 MB a fast machine meets the limit.
fuzz: ## every reader on random input under libFuzzer (clang), FUZZ_SECONDS each; what is new goes to build/fuzz/corpus
	$(MAKE) B=$(B)/fuzz CC=clang CFLAGS="-O1 -g" EXTRA="-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all" \
	  $(FUZZ:%=$(B)/fuzz/fuzz-%)
	@for t in $(FUZZ); do mkdir -p $(B)/fuzz/corpus/$$t; echo "fuzz: $$t, $(FUZZ_SECONDS) s"; \
	  ASAN_OPTIONS=quarantine_size_mb=32 $(B)/fuzz/fuzz-$$t -max_total_time=$(FUZZ_SECONDS) -timeout=5 -rss_limit_mb=400 \
	    -max_len=8192 -close_fd_mask=3 \
	    -dict=tests/fuzz/$$t.dict -artifact_prefix=$(B)/fuzz/ -print_final_stats=1 $(B)/fuzz/corpus/$$t tests/fuzz/corpus/$$t \
	    > $(B)/fuzz/$$t.log 2>&1 || { tail -40 $(B)/fuzz/$$t.log; exit 1; }; grep -E '^(Done|stat::number)' $(B)/fuzz/$$t.log; done

fresh: ## as root: README's two commands and the digests in a fresh Debian of another release, by debootstrap; RELEASE=trixie
	sh tools/fresh.sh $(RELEASE)

cover: ## line coverage of src/, and the messages that no test reaches
	-$(MAKE) B=$(B)/cover CFLAGS="-O0 -g" EXTRA="--coverage -include tests/counted.h" check
	gcovr -r . $(B)/cover --filter src/ --sort-uncovered | tail -40
	-$(PYTHON) tools/untested.py $(B)/cover

format: ## rewrite the sources in the project's format
	clang-format -i $$(git ls-files '*.c' '*.h')

install: all ## install program, library, headers, Python module, man pages, completion and data (PREFIX, DESTDIR)
	install -d $(addprefix $(DESTDIR),$(BINDIR) $(LIBDIR)/pkgconfig $(INCDIR)/stickslip $(MANDIR)/man1 $(MANDIR)/man3 $(MANDIR)/man5 $(PYDIR) $(DATADIR) $(COMPDIR) $(ZSHDIR) $(FISHDIR))
	install $(B)/$(if $(MPI),mpi/)stickslip $(B)/stickslip-checker $(DESTDIR)$(BINDIR)/
	install -m 644 $(B)/libstickslip.a $(DESTDIR)$(LIBDIR)/
	install -m 755 $(B)/$(SO) $(DESTDIR)$(LIBDIR)/
	ln -sf $(SO) $(DESTDIR)$(LIBDIR)/libstickslip.so
	install -m 644 $(API)/stickslip.h $(DESTDIR)$(INCDIR)/
	install -m 644 $(API)/stickslip/* $(DESTDIR)$(INCDIR)/stickslip/
	install -m 644 man/stickslip.1 $(DESTDIR)$(MANDIR)/man1/
	install -m 644 $(wildcard man/*.3) $(DESTDIR)$(MANDIR)/man3/
	install -m 644 $(wildcard man/*.5) $(DESTDIR)$(MANDIR)/man5/
	install -m 644 python/stickslip.py $(DESTDIR)$(PYDIR)/
	install -m 644 tools/completion.bash $(DESTDIR)$(COMPDIR)/stickslip
	sed 's|@COMPDIR@|$(COMPDIR)|' tools/completion.zsh > $(DESTDIR)$(ZSHDIR)/_stickslip
	sed 's|@COMPDIR@|$(COMPDIR)|' tools/completion.fish > $(DESTDIR)$(FISHDIR)/stickslip.fish
	sed 's|@PREFIX@|$(PREFIX)|; s|@LIBDIR@|$(LIBDIR)|; s|@INCLUDEDIR@|$(INCDIR)|; s|@VERSION@|$(VERSION)|' tools/stickslip.pc.in \
	  | sed 's|@PRIVATE@|$(CALCIUM) $(ARB) -lflint -lgmp -ldl|' \
	  > $(DESTDIR)$(LIBDIR)/pkgconfig/stickslip.pc
	cp -R verify/. $(DESTDIR)$(DATADIR)/

uninstall: ## remove what install put there
	rm -f $(addprefix $(DESTDIR)$(BINDIR)/,stickslip stickslip-checker) $(DESTDIR)$(LIBDIR)/libstickslip.a $(DESTDIR)$(LIBDIR)/$(SO) \
	  $(DESTDIR)$(LIBDIR)/libstickslip.so $(DESTDIR)$(LIBDIR)/pkgconfig/stickslip.pc $(DESTDIR)$(MANDIR)/man1/stickslip.1 \
	  $(patsubst man/%,$(DESTDIR)$(MANDIR)/man3/%,$(wildcard man/*.3)) $(patsubst man/%,$(DESTDIR)$(MANDIR)/man5/%,$(wildcard man/*.5)) \
	  $(DESTDIR)$(PYDIR)/stickslip.py $(DESTDIR)$(PYDIR)/__pycache__/stickslip.*.pyc $(addprefix $(DESTDIR),$(COMPDIR)/stickslip $(ZSHDIR)/_stickslip $(FISHDIR)/stickslip.fish)
	rm -rf $(DESTDIR)$(INCDIR)/stickslip $(DESTDIR)$(INCDIR)/stickslip.h $(DESTDIR)$(DATADIR)

clean: ## remove build/
	rm -rf $(B)

help: ## this list
	@sed -n 's/^\([a-z]*\):.*## /\1\t/p' Makefile | expand -t 10
