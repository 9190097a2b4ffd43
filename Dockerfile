# The service and its cockpit on port 8000:
#   docker build -t relguide . && docker run --read-only -p 8000:8000 -v relguide:/data relguide
# A base that is pinned: --build-arg BASE=python:3.12-slim@sha256:…, with the digest that
# `docker buildx imagetools inspect python:3.12-slim` tells. Fewer processes that compile, each of
# which may take 1 GB: --build-arg JOBS=1; else as many as cores and memory allow.
# Nothing here is for one kind of processor: amd64 and arm64 each build their own image.
ARG BASE=python:3.12-slim

FROM ${BASE} AS build
ENV PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_NO_CACHE_DIR=1 NUMBA_CPU_NAME=generic
WORKDIR /src
RUN python -m venv /opt/relguide
ENV PATH=/opt/relguide/bin:$PATH

# What it depends on, each file by its hash (`make lock`): torch is not among it.
COPY requirements.lock ./
RUN pip install --no-deps --require-hashes --requirement requirements.lock
# What is installed carries the web page, built here with a Node that pip brings.
COPY . .
# The guide, by tools that go no further than this stage.
RUN python -m venv /guide \
    && /guide/bin/pip install zensical==0.0.73 "mkdocstrings-python>=2.0.11,<2.1" \
    && /guide/bin/python -m zensical build --strict
# It is this source tree that is installed, so there is no version to pin.
# hadolint ignore=DL3013
RUN RELGUIDE_GUIDE=build/guide pip install --no-deps .
# The kernels are compiled beside what is installed, for any CPU of this kind: that costs no speed,
# and the image may run elsewhere than it was built, as any user, with a read-only disk.
ARG JOBS=
WORKDIR /
RUN relguide warm-up ${JOBS:+--jobs $JOBS}


FROM ${BASE}
LABEL org.opencontainers.image.title="relguide" \
      org.opencontainers.image.description="Minimum-time relative guidance of aircraft" \
      org.opencontainers.image.licenses="Apache-2.0"
RUN useradd --uid 10001 --create-home relguide && install -d -o 10001 -g 10001 /data
COPY --from=build /opt/relguide /opt/relguide
# NUMBA_CPU_NAME: whom the kernels were compiled for.
ENV PATH=/opt/relguide/bin:$PATH \
    PYTHONUNBUFFERED=1 \
    PYTHONDONTWRITEBYTECODE=1 \
    NUMBA_CPU_NAME=generic \
    RELGUIDE_DATA=/data
# What is on record; without a volume it goes with the container. Nothing else is written.
VOLUME /data
USER 10001
WORKDIR /home/relguide

EXPOSE 8000
STOPSIGNAL SIGTERM
# Healthy while it plans.
HEALTHCHECK --interval=10s --timeout=5s --start-period=20s CMD ["python", "-m", "relguide_server.http.health"]
ENTRYPOINT ["relguide"]
CMD ["serve", "--host", "0.0.0.0", "--port", "8000"]
