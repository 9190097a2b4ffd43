"""The page that Prometheus reads."""

from relguide_server.metrics import BUCKETS, Metrics


def test_the_histogram_is_cumulative_and_ends_with_all() -> None:
    metrics = Metrics()
    for seconds in (0.00005, 0.0001, 0.0002, 5.0):
        metrics.count_plan("planned", seconds)
    metrics.count_plan("no_plan", 0.02)
    lines = metrics.text(flights_running=2, stream_clients=3, scene_clients=1).splitlines()
    buckets = [int(li.split()[1]) for li in lines if li.startswith("relguide_plan_seconds_bucket")]
    assert len(buckets) == len(BUCKETS) + 1
    assert buckets == sorted(buckets)
    assert buckets[0] == 2  # an upper end belongs to its bucket
    assert buckets[-1] == 5
    assert 'relguide_plans_total{status="planned"} 4' in lines
    assert "relguide_flights_running 2" in lines
    assert "relguide_plan_seconds_count 5" in lines


def test_every_number_is_described() -> None:
    text = Metrics().text(flights_running=0, stream_clients=0, scene_clients=0)
    names = {line.split("{")[0].split(" ")[0] for line in text.splitlines() if line[0] != "#"}
    described = {line.split()[2] for line in text.splitlines() if line.startswith("# TYPE")}
    stems = {n.removesuffix("_bucket").removesuffix("_sum").removesuffix("_count") for n in names}
    assert stems == described
