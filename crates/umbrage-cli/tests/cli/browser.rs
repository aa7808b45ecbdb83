//! The page of `umbrage view` in headless Chromium, driven by its WebDriver where that is installed.

use crate::pages::Page;
use crate::web_driver::{Browser, DOWN, ENTER, ESCAPE, RIGHT, SHIFT};

#[test]
fn a_page_is_used_in_chromium() {
    for (width, height) in [(1280, 900), (500, 844)] {
        let Some(browser) = Browser::new(width, height) else {
            println!("skipped: the page in Chromium, for want of chromedriver");
            return;
        };
        let page = Page::new(&["gallery:table", "--size", "96x72", "--map-size", "64", "--samples", "1"]);
        browser.open(&page.address);
        browser.rest();
        assert_eq!(browser.text("document.querySelector('#recipe').value"), "auto");
        let line = || browser.text("document.querySelector('#lines pre').textContent");
        assert_eq!(line(), "umbrage render gallery:table --size 96x72 --map-size 64 --samples 1 -o table.png");
        assert!(browser.is("document.documentElement.scrollWidth <= innerWidth"), "something sticks out at {width}");
        let hash = || browser.text("location.hash");
        let first = browser.pixels(0.0, 1.0);

        // Another recipe, and a field of it.
        browser.choose("recipe", "reeves87");
        browser.rest();
        browser.choose("field-bias", "0");
        browser.rest();
        assert_eq!(hash(), "#recipe=reeves87%2Cbias%3D0");
        let acne = browser.pixels(0.0, 1.0);
        assert_ne!(acne, first);
        browser.choose("field-jitter", "7");
        let problem = "document.querySelector('#problem')";
        browser.until(&format!("{problem}.textContent.includes('jitter = \"7\": expected a number from 0 to 1')"));
        browser.choose("field-jitter", "");
        browser.rest();
        assert_eq!(browser.pixels(0.0, 1.0), acne, "what was there before is there again");
        browser.until(&format!("{problem}.hidden"));

        // The light by the pointer, by keys, by numbers, and back.
        browser.stroke(&[[0.5, 0.5], [0.6, 0.5], [0.7, 0.45]]);
        browser.rest();
        let dragged = hash();
        assert!(dragged.contains("turn=lamp%3D"), "{dragged}");
        assert!(line().contains("--turn-light lamp="));
        assert_ne!(browser.pixels(0.0, 1.0), acne);
        browser.script("document.querySelector('canvas').focus()");
        browser.keys(&[SHIFT], &[RIGHT, DOWN]);
        browser.rest();
        assert_ne!(hash(), dragged);
        browser.choose("azimuth-number", "180");
        browser.choose("elevation-number", "25");
        browser.rest();
        assert!(hash().contains("turn=lamp%3D180%2C25"), "{}", hash());
        browser.script("document.querySelector('#back').click()");
        browser.rest();
        assert_eq!(browser.pixels(0.0, 1.0), acne);

        // A pixel by the pointer, and one by keys.
        let words = "document.querySelector('#words')";
        browser.stroke(&[[60.5 / 96.0, 44.5 / 72.0]]);
        browser.until(&format!("{words}.textContent.includes('pixel 60,44 under lamp by reeves87,bias=0')"));
        assert!(browser.is(&format!("{words}.querySelectorAll('svg circle').length > 0")));
        browser.keys(&[], &[RIGHT, DOWN, ENTER]);
        browser.until(&format!("{words}.textContent.includes('pixel 61,45 under lamp')"));
        browser.keys(&[], &[ESCAPE]);
        browser.until("document.querySelector('#why').hidden && !location.hash.includes('pixel')");

        // Truth on the right, pulled to the left by its line and put back by its slider.
        browser.script("document.querySelector('#wiping').click()");
        browser.until("document.querySelector('#right').textContent === 'rays'");
        browser.rest();
        let (left, right) = (browser.pixels(0.0, 0.45), browser.pixels(0.55, 1.0));
        browser.stroke(&[[0.5, 0.5], [0.3, 0.5], [0.1, 0.5]]);
        browser.rest();
        assert!(hash().contains("wipe=0.1") && !hash().contains("turn"), "the line moves, the light stays: {}", hash());
        assert_ne!(browser.pixels(0.0, 0.45), left);
        assert_eq!(browser.pixels(0.55, 1.0), right, "truth is what it was");
        browser.choose("wipe", "1");
        browser.rest();
        let wiped = hash();

        // Heat maps, and an address that somebody kept.
        browser.choose("show", "acne");
        browser.rest();
        browser.until("document.querySelector('#faults').textContent.includes('acne')");
        let heat = browser.pixels(0.0, 1.0);
        browser.open(&format!("{}{wiped}", page.address));
        browser.rest();
        assert_eq!(browser.text("document.querySelector('#field-bias').value"), "0");
        assert_ne!(browser.pixels(0.0, 1.0), heat);

        // The page says so once the command has ended.
        drop(page);
        browser.choose("map-size", "128");
        browser.until(&format!("{problem}.textContent.startsWith('The command has ended')"));
    }
}
