# The service and its cockpit on port 8000: docker build -t relguide . && docker run -p 8000:8000 relguide
# On Linux the default torch brings CUDA along; an index with CPU wheels saves gigabytes:
#   docker build --build-arg TORCH_INDEX=<PyTorch's index of CPU wheels> -t relguide .

FROM python:3.12-slim AS build
ARG TORCH_INDEX=""
ENV PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_NO_CACHE_DIR=1
WORKDIR /src
RUN python -m venv /opt/relguide
ENV PATH=/opt/relguide/bin:$PATH

# The largest part first: it changes least.
COPY pyproject.toml ./
RUN sed -n 's/.*"\(torch==[^"]*\)".*/\1/p' pyproject.toml > /tmp/torch.txt \
 && pip install ${TORCH_INDEX:+--index-url "$TORCH_INDEX"} --requirement /tmp/torch.txt

# The wheel carries the web page, built here with a Node that pip brings.
COPY . .
RUN pip wheel --no-deps --wheel-dir /wheels . && pip install "$(echo /wheels/relguide-*.whl)[serve]"


FROM python:3.12-slim
LABEL org.opencontainers.image.title="relguide" \
      org.opencontainers.image.description="Minimum-time relative guidance of aircraft" \
      org.opencontainers.image.licenses="Apache-2.0"
RUN useradd --uid 10001 --create-home relguide
COPY --from=build /opt/relguide /opt/relguide
# The kernels are compiled here, once, for any CPU of this kind: that costs no speed, and the image
# may run elsewhere than it was built, as any user, with a read-only disk.
ENV PATH=/opt/relguide/bin:$PATH \
    PYTHONUNBUFFERED=1 \
    NUMBA_CPU_NAME=generic \
    NUMBA_CACHE_DIR=/opt/relguide/kernels
RUN python -m relguide.warm_up
USER 10001
WORKDIR /home/relguide

EXPOSE 8000
HEALTHCHECK --interval=10s --timeout=3s --start-period=20s \
    CMD ["python", "-c", "from urllib.request import urlopen; urlopen('http://127.0.0.1:8000/healthz', timeout=2)"]
ENTRYPOINT ["relguide"]
CMD ["serve", "--host", "0.0.0.0", "--port", "8000"]
